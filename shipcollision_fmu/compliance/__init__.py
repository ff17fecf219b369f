"""Compliance of an FMU file with FMI 2.0 or 3.0.

    report.py   validate(): FMPy's validator, then the rules, then the calls, as a list of findings
    rules.py, archive_rules.py    rules for modelDescription.xml and the archive that FMPy does not check
    subject.py  an FMU file as the rules need it
    calls.py    the probes made in another process, which an FMU may crash
    probes.py   calls that an FMU must refuse or repeat exactly
    instance.py an FMU instance with these calls, for both versions of FMI

Data flow: FMU file -> Subject (rules) and Instance (calls) -> Finding. Imports from: fmi (record of a build), errors;
FMPy. Used by: cli.
"""
