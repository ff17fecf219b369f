"""run_study(): the rows of a study, computed in batches by many workers, and its folder of Parquet files.

    run.py           run_study(); result.py: what it returns
    options.py       the check of its options
    main_guard.py    the guard that a script with worker processes needs
    session.py       one call of it, from the folder's check to its status
    loop.py          Loop: hands out batches and writes the parts that come of the answers
    parts.py         Part: the fixed ranges of rows, a file each
    batches.py       Batch, and BatchPlan: ranges of rows within parts, sized by measured cost
    work.py          compute_batch(): what a worker does
    part_file.py     a part as the bytes of a Parquet file, and what its mark says
    assembly.py      Assembly: batches put together to parts
    executor.py      what the loop asks of an executor
      in_process.py      batches computed by this process
      dask_executor.py   batches computed by a Dask cluster; whatever is lost comes back to the plan
        clusters.py        a local cluster, or one that exists
        local_worker.py    what each worker of a local cluster loads
        versions.py        members of a cluster with another version of this package
    interface.py     what the engine asks of a study
    changes.py       what has changed in a study since its folder was begun
    folder.py        StudyFolder: what is there, what is missing, what is of other origin
    csv_tables.py    both tables as CSV
    reasons.py       why rows are refused

Data flow: study -> parts -> batches -> workers -> bytes -> assembly -> folder. The client alone writes, so workers need
no common disk. Bytes of a part depend on the study alone: not on workers, batches, order or resumption.
"""
