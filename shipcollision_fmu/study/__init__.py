"""Studies: a million encounters, drawn from distributions, on one machine or on a Dask cluster.

    definition/   the study file becomes a Study: distributions, fleets, tables of data, checks
    rows/         compute_rows(): some rows of a study as two tables, by row number alone
    engine/       run_study(): batches, workers, the folder of Parquet files
    report/       write_report(): figures and a page from that folder
    closed_forms/ estimate_energies(): formulas of the literature for the rows, beside the simulation
    extra.py      pyarrow and Dask, which studies alone need

Data flow: study file -> Study -> rows -> tables -> folder -> report. Imports from: batch, cosim, encounters,
scenario, show (style of figures), collision, fmi (names), ship, toolchain. Used by: cli and users of the package.
"""
