"""Scenarios run in time: a master, its components, the helms of the ships, and the finished run.

    simulate.py         simulate(): a Scenario becomes a Run
    stepper.py          the instances of a scenario, advanced from communication point to point
    master.py           the two algorithms, gauss-seidel and jacobi; System and Wire
    wiring.py           a scenario becomes a System of connected instances; parameters.py has their parameters
    component.py        what a master asks of an instance, and a model in process that answers it
      fmi2_component.py, fmi3_component.py    instances of FMUs; fmu_instance.py has what both versions share
      track_component.py     a ship that follows a recorded track
      factories.py      makes the components of a run
      fmu_files.py      where the FMUs of a run lie, built when they are missing
      native_fmu_files.py, prepared_files.py  FMUs without Python made for a run, and the ships and obstacles they read
    helm.py             timed orders and steering of one ship; scenario_helm.py reads them from a scenario
      autopilot.py, route.py, evasion.py      the laws of steering
    recorder.py         writes down states and contacts at communication points: the Record of results/
      row_log.py        rows of a growing table, in memory or in a temporary file
    folder_lock.py      one process at a time writes into a folder; earlier_run.py: whether a run is there
    interrupt.py        Ctrl-C waits for the end of the step
    run.py              Run: tables, events and files of a finished run
      run_repr.py, run_frames.py, run_page.py     as text and HTML, as data frames, as a page in a notebook

Data flow: Scenario -> instances and wires (System) -> steps -> Record -> events, summary, bodies (results/) -> Run.
Imports from: results, show (the page of a run only), scenario, fmi, manoeuvring (prepared ships), collision (interface,
obstacles), ship, toolchain (native code). Used by: batch, cli, packaging and users of the package.
"""
