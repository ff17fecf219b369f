"""Compiling of native/: sources, compilers, and what they made, kept in the user's cache. Standard library only.

    bullet_sources   Bullet's files, fetched by pip from pybullet's source distribution

Imports: files and errors.
"""
