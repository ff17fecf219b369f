"""From native/ to a shared library: for this machine, or for the platforms of an FMU.

platforms       what an FMU can be built for, and which of it this machine is
compilers       Zig's compiler from PyPI for all platforms, or the system's for this machine
sources         native/ and the headers of FMI, as parts that are compiled alike
bullet_sources  Bullet's files, fetched by pip from pybullet's source distribution
objects         one source compiled, kept by what it is made from
libraries       a shared library linked, kept by what it is made from
mach_o, pe      what a linker leaves to do for macOS and for Windows
installed       the library that came with the package, compiled when it was installed
install         what puts it there
load            the library for this machine, opened by ctypes

Data flow: sources -> objects -> library -> ctypes, or bytes for the builder of FMUs. Imports from: files, errors.
Used by: fmi (the builder), collision (geometry), batch, cli.
"""
