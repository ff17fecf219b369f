"""From an Interface to an .fmu file. Nothing of this room travels inside an FMU.

model_description         modelDescription.xml: what both versions of FMI share
model_description_fmi2    and what is of FMI 2.0
model_description_fmi3    and of FMI 3.0
documentation             the page for people, and what else they read
terminals                 what belongs together, in FMI 3.0
zip_archive               an archive that depends on names and contents only
package                   the .fmu files: what is in them, and whether a file is up to date
native_variables          the table of variables as native FMUs read it
native_sources            the C++ sources inside a native FMU
native_fmus               the .fmu files without Python

Data flow: Interface and the files of build_record -> XML, documentation, sources -> bytes of the .fmu file. Imports
from: fmi, toolchain, manoeuvring and ship for prepared ships, and pythonfmu and pythonfmu3 for what they bring. Used
by: cosim, packaging, cli.
"""
