"""Studies: a million encounters, drawn from distributions, on one machine or on a Dask cluster.

    engine/   run_study(): batches, workers, the folder of Parquet files

Imports from: cosim (interrupt.py). Used by: cli, users of the package.
"""
