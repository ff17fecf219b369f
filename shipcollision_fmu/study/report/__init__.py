"""The report of a study: figures and a page from its folder of Parquet files.

    report.py        write_report(): report.html, and figures/ with PNG, SVG and CSV
    page.py          the page, in one file that needs no network
    figures.py       the figures by Matplotlib
    charts.py        what is drawn: numbers, axes and captions
    study_table.py   StudyTable: columns of the encounters, read part by part
    worst.py         the cases that lose most energy
    ship_names.py    names of ships from files
    replays.py       rows computed again, and run for their replays
    statistics, pure functions of arrays:
      exceedance.py    exceedance curve; clopper_pearson.py: its band
      binned.py        quantiles by bin
      convergence.py   mean and 99 % quantile with the number of cases
      sensitivity.py   variance of conditional means, rank correlation
      reasons.py       the commonest reason of refusals
    counts.py        numbers of cases in words

Data flow: folder -> StudyTable -> statistics -> charts -> figures -> page. Imports from: engine (marks of parts),
definition, show (style of figures). Used by: cli.
"""
