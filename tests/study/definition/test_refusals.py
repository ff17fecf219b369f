"""Bad study files: one clear line each, with the key, its value, the limit and the remedy."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest

from shipcollision_fmu.errors import StudyError
from shipcollision_fmu.study.definition.study import parse_study, read_study

GOOD = """
[study]
name = "strait"
level = "impact"
rows = 100
[own]
ships = ["kcs"]
[encounter]
own_speed = {distribution = "uniform", least = 2.0, most = 8.0}
"""
END = '"impact"' + GOOD.partition('"impact"')[2]
SAILED = END.partition("[encounter]")[0].replace("impact", "sailed")
BESIDE = SAILED + '[situations]\nfolder = "."\n[encounter]\n'
SPEED = 'own_speed = {distribution = "uniform", least = 2.0, most = 8.0}'
SHIPS = 'ships = ["kcs"]'
POOL = """[[own.sampled]]
kind = "tanker"
L_pp = 200.0
L_over_B = 6.0
B_over_T = 2.6
C_b = 0.8"""
TABLES = {"data.csv": "v,word,ship,w\n3.0,port,kcs,1\n70.0,left,titanic,-1\n"}
MANY = "".join(f'[tables.t{i}]\nfile = "good.csv"\n' for i in range(32))
DATA = '\n[tables.data]\nfile = "data.csv"'

REFUSALS: dict[str, tuple[tuple[str, str], str]] = {
    # -- [study]
    "no table [study]": (("[study]", "[stdy]"), "[stdy] is not a known key: did you mean study?"),
    "no name": (('name = "strait"', ""), "[study] name is missing: give the name of the study"),
    "a name with a slash": (('"strait"', '"a/b"'), "[study] name: 'a/b' cannot name a folder: take letters"),
    "an unknown level": (('"impact"', '"contact"'), "[study] level = 'contact' must be 'impact', 'encounter' or"),
    "no rows": (("rows = 100", ""), "[study] rows is missing: give the number of cases, or a table [grid]"),
    "rows of 0": (("rows = 100", "rows = 0"), "[study] rows = 0 must be greater than or equal to 1"),
    "rows as text": (("rows = 100", 'rows = "100"'), "[study] rows = '100' must be a whole number"),
    "rows as a float": (("rows = 100", "rows = 1e6"), "[study] rows = 1000000.0 must be a whole number"),
    "too many rows": (("rows = 100", "rows = 100_000_000_000"), "[study] rows = 100000000000 must be less than"),
    "a grid of too many cells": (
        ("rows = 100", "[grid]\nat = {least = -0.4, most = 0.4, count = 100000}\n"
         "angle_deg = {least = 20, most = 160, count = 100000}\nheading_deg = [0, 90]"),
        "[grid] has 20000000000 cells, the limit is 10000000000: take fewer values of a key",
    ),
    "a negative seed": (("rows = 100", "rows = 100\nseed = -1"), "[study] seed = -1 must be greater than or equal"),
    "an unknown sampler": (
        ("rows = 100", 'rows = 100\nsampler = "halton"'), "[study] sampler = 'halton' must be 'latin-hypercube', ",
    ),
    "a seed that is a word": (
        ("rows = 100", 'rows = 100\nseed = "abc"'),
        "[study] seed = 'abc' must be a whole number: it is the start of the random numbers",
    ),
    "a duration": (
        ("[encounter]", "[run]\nduration = 60.0\n[encounter]"),
        "[run] duration is not a known key: a case ends `after` seconds after the impact, or so long after the last",
    ),
    "a time step": (
        ("[encounter]", "[run]\ndt = 0.1\n[encounter]"), "[run] dt is not a known key: the communication step is `step`"
    ),
    "a misspelt key": (("rows = 100", "row = 100"), "[study] row is not a known key: did you mean rows?"),
    # -- [own] and [target]
    "no own": (("[own]\n" + SHIPS, ""), "[own] is missing: give the table [own]: the ships that strike"),
    "no ships": ((SHIPS, ""), 'has no ships: give ships = ["kvlcc2"], or a table [[own.sampled]]'),
    "an empty list of ships": ((SHIPS, "ships = []"), "[own] ships: the value [] must name ships: "),
    "an unknown ship": ((SHIPS, 'ships = ["kvlc2"]'), "[own] ships: kvlc2: unknown ship 'kvlc2': did you mean kvlcc2?"),
    "a missing ship file": (
        (SHIPS, 'ships = ["my/ship.toml"]'), "[own] ships: my/ship.toml: no such file in ",
    ),
    "a ship twice": ((SHIPS, 'ships = ["kcs", "kcs"]'), "[own] ships: 'kcs' is there twice: give a table of weights"),
    "a negative weight": (
        (SHIPS, "ships = {kcs = -1.0}"), "kcs = -1.0 must be a weight, a number of at least 0",
    ),
    "no weight above 0": (
        (SHIPS, "ships = {kcs = 0.0}"), "[own]: all weights are 0: give a ship or a pool a weight above 0",
    ),
    "no weight above 0 with a pool": (
        (SHIPS, "ships = {kcs = 0}\n" + POOL + "\nweight = 0"), "[own]: all weights are 0: give a ship or a pool a",
    ),
    "a negative weight of a pool": ((SHIPS, POOL + "\nweight = -1"), "[own] sampled[0].weight = -1 must be greater"),
    "a loading out of range": (
        (SHIPS, SHIPS + "\nloading = 0.1"), "[own]: loading = 0.1 must be 0.3 to 1: 1 is the draught of the ship file",
    ),
    "a loading of many values": (
        (SHIPS, SHIPS + '\nloading = {distribution = "uniform", least = 0.5, most = 1.0}'),
        "[own]: loading must be a number or discrete: each value makes another ship of each name",
    ),
    "a loading of a mesh": (
        (SHIPS, 'ships = ["mesh_example"]\nloading = 0.8'), "a hull from a mesh has one draught: take loading = 1",
    ),
    "an unknown kind of ship": (
        (SHIPS, POOL.replace("tanker", "submarine")), "'submarine' names no type of ship: take one of the words ferry",
    ),
    "a misspelt kind of ship": (
        (SHIPS, POOL.replace("tanker", "tankr, loaded")), "'tankr, loaded' names no type of ship: did you mean tanker?",
    ),
    "a ratio by its letters": (
        (SHIPS, POOL.replace("L_over_B", "L_B")), "[own.sampled.0] L_B is not a known key: did you mean L_over_B?",
    ),
    "breadth given twice": ((SHIPS, POOL + "\nB = 30.0"), "has B and L_over_B: give one of the two"),
    "no draught": (
        (SHIPS, POOL.replace("B_over_T = 2.6", "")), "has neither T nor B_over_T: give one of the two",
    ),
    "a length in feet": ((SHIPS, POOL.replace("200.0", "650.0")), "L_pp = 650 must be 0.5 to 500: give metres"),
    "a pool of no ship": ((SHIPS, POOL + "\ncount = 0"), "count = 0 must be greater than or equal to 1"),
    "a block coefficient without end": (
        (SHIPS, POOL.replace("C_b = 0.8", 'C_b = {distribution = "normal", mean = 0.8, sd = 0.05}')),
        "C_b goes down to -inf, must be 0.4 to 0.9: change or give least",
    ),
    # -- [encounter]
    "an unknown variable": ((SPEED, "own_sped = 3.0"), "[encounter] own_sped is not a known key: did you mean own_spe"),
    "an unknown kind of encounter": (
        (SPEED, 'kind = "tbone"'), "[encounter] kind = 'tbone' is unknown: did you mean t-bone?",
    ),
    "a kind that is a number": ((SPEED, "kind = 3"), "[encounter] kind must be a word, or discrete with words: take"),
    "an unknown side": ((SPEED, 'side = "left"'), "[encounter] side = 'left' is unknown: known: port, starboard"),
    "a speed in knots": ((SPEED, "own_speed = 120.0"), "own_speed = 120 must be -50 to 50: give metres per second"),
    "a speed that is a word": ((SPEED, 'own_speed = "fast"'), "own_speed = 'fast' must be a number, -50 to 50: give"),
    "a speed that is not finite": ((SPEED, "own_speed = nan"), "[encounter] own_speed: the value nan must be a finite"),
    "a list without a distribution": (
        (SPEED, "own_speed = [2.0, 4.0]"), 'a list of values is {distribution = "discrete", values = [...]}',
    ),
    "no word for the distribution": (
        (SPEED, "own_speed = {least = 2.0, most = 3.0}"), "[encounter.own_speed] distribution is missing: give one of",
    ),
    "an unknown distribution": (
        (SPEED, 'own_speed = {distribution = "gauss", mean = 3.0}'),
        "[encounter.own_speed] distribution = 'gauss' is unknown: known: constant, uniform, normal,",
    ),
    "a misspelt key of a distribution": (
        (SPEED, 'own_speed = {distribution = "normal", mean = 3.0, std = 1.0, least = 0.0, most = 9.0}'),
        "std is not a known key: did you mean sd?",
    ),
    "a key of a distribution that is no word": (
        (SPEED, 'own_speed = {distribution = "uniform", least = 1.0, most = 2.0, -1 = 3.0}'),
        "[encounter.own_speed] -1 is not a known key: known: distribution, least, most",
    ),
    "a table that is not there, of a pool": (
        (SHIPS, POOL.replace("C_b = 0.8", 'C_b = {table = "data", column = "v"}')),
        "[own] sampled[0].C_b: table = 'data' is not in [tables]: add a table [tables.NAME] with file",
    ),
    "a negative standard deviation": (
        (SPEED, 'own_speed = {distribution = "normal", mean = 3.0, sd = -1.0, least = 0.0, most = 9.0}'),
        "[encounter.own_speed] sd = -1.0 must be greater than 0: it is the standard deviation",
    ),
    "limits in falling order": (
        (SPEED, 'own_speed = {distribution = "uniform", least = 8.0, most = 2.0}'),
        "[encounter.own_speed] least = 8 must be below most = 2: exchange them",
    ),
    "a mode outside": (
        (SPEED, 'own_speed = {distribution = "triangular", least = 2.0, mode = 9.0, most = 8.0}'),
        "[encounter.own_speed] mode = 9 must be between least = 2 and most = 8: put the three in rising order",
    ),
    "cuts that leave nothing": (
        (SPEED, 'own_speed = {distribution = "normal", mean = 3.0, sd = 0.1, least = 5.0, most = 9.0}'),
        "[encounter.own_speed] least and most leave 3e-89 of the distribution, at least 1e-09 is needed: move them",
    ),
    "a distribution without end": (
        (SPEED, 'own_speed = {distribution = "normal", mean = 3.0, sd = 1.0}'),
        "own_speed goes down to -inf, must be -50 to 50: change or give least; give metres per second",
    ),
    "a tail without end": (
        (SPEED, 'own_speed = {distribution = "lognormal", median = 3.0, sigma = 1.0}'),
        "own_speed goes up to inf, must be -50 to 50: change or give most; give metres per second",
    ),
    "weights that do not fit": (
        (SPEED, 'own_speed = {distribution = "discrete", values = [2, 3], weights = [1]}'),
        "[encounter.own_speed] weights has 1 entries and values has 2: give one weight for each",
    ),
    "weights that are all 0": (
        (SPEED, 'own_speed = {distribution = "discrete", values = [2, 3], weights = [0, 0]}'),
        "[encounter.own_speed] weights are all 0: give at least one that is above 0",
    ),
    "numbers among words": (
        (SPEED, 'own_speed = {distribution = "discrete", values = [2, "a"]}'),
        "values: the value [2, 'a'] must be a list of finite numbers, or of words, e.g. [2.0, 5.0]",
    ),
    "a variable of another level": (
        (SPEED, "rudder_deg = 10.0"),
        '[encounter] rudder_deg has no effect at level = "impact": remove it, or take level = "sailed"',
    ),
    "a kind of another level": (
        (SPEED, 'kind = "late-evasive"'),
        '[encounter] kind = "late-evasive" needs ships that steer: take level = "sailed", or another kind',
    ),
    "an angle of another kind": (
        (SPEED, 'kind = "overtaking"\nangle_deg = 90.0'),
        '[encounter] angle_deg goes from 90 to 90, must be 0 to 67.5 for kind "overtaking": change it, or take',
    ),
    "a drift of a kind without it": (
        (SPEED, "drift_speed = 1.0"),
        '[encounter] drift_speed has no effect with kind "crossing": remove it, or take kind drifting-target',
    ),
    "a speed of a target that drifts": (
        (SPEED, 'kind = "drifting-target"\ntarget_speed = 1.0'),
        '[encounter] target_speed has no effect with kind "drifting-target": remove it, or take kind head-on',
    ),
    # -- [run]
    "degrees of freedom of no ship": ((SPEED, "[run]\ndegrees_of_freedom = 5"), "degrees_of_freedom = 5 must be 3, 4"),
    "a time in minutes": ((SPEED, "[run]\nafter = 0.0"), "[run] after = 0.0 must be greater than 0"),
    "too many steps": (
        (SPEED, "[run]\nafter = 7200.0\nstep = 0.001"),
        "[run] step = 0.001 s makes 7201000 steps, the limit is 1000000: take a longer step",
    ),
    "a step that is too short with the usual time to the impact": (
        ("[encounter]", "[run]\nstep = 0.001\nafter = 1000.0\n[encounter]"),
        "[run] step = 0.001 s makes 1001000 steps, the limit is 1000000: take a longer step",
    ),
    # -- [grid]
    "an unknown axis": ((SPEED, "[grid]\nangel_deg = [30.0]"), "[grid] angel_deg is not a known key: did you mean"),
    "an axis that is drawn, too": (
        (SPEED, SPEED + "\n[grid]\nown_speed = [3.0]"), "[grid] own_speed is also a key of [encounter]: remove one of",
    ),
    "an axis of one number": ((SPEED, "[grid]\nat = 0.1"), "at: the value 0.1 must be a list of numbers or"),
    "a value twice": ((SPEED, "[grid]\nat = [0.1, 0.1]"), "at: the list [0.1, 0.1] has a value twice: remove"),
    "an axis out of range": (
        (SPEED, "[grid]\nat = {least = -0.5, most = 0.7, count = 3}"), "[grid] at = 0.7 must be -0.5 to 0.5: -0.5 is",
    ),
    "an axis of one step": (
        (SPEED, "[grid]\nat = {least = -0.5, most = 0.5, count = 1}"), "count = 1 must be a whole number, 2 to 100000",
    ),
    "rows that are no whole grid": (
        (SPEED, "[grid]\nat = [-0.1, 0.0, 0.1]"),
        "[study] rows = 100 is 33.33 times the 3 cells of [grid], must be a whole number of times: take 99 or 102",
    ),
    # -- [tables]
    "a missing table": (
        (SPEED, '[tables.data]\nfile = "no.csv"'), "[tables.data] file = 'no.csv' cannot be read in ",
    ),
    "a table that is not there": (
        (SPEED, 'own_speed = {table = "data", column = "v"}'),
        "[encounter] own_speed: table = 'data' is not in [tables]: add a table [tables.NAME] with file",
    ),
    "a column that is not there": (
        (SPEED, 'own_speed = {table = "data", column = "x"}' + DATA),
        "[encounter] own_speed: column = 'x' is not in table 'data': known: v, word, ship, w",
    ),
    "a column of words": (
        (SPEED, 'own_speed = {table = "data", column = "word"}' + DATA),
        "own_speed: column 'word' of table 'data' holds 'port' in line 2, must hold numbers: take another column",
    ),
    "a column with a word among its numbers": (
        (SPEED, 'own_speed = {table = "data", column = "w"}' + DATA.replace("data.csv", "gap.csv")),
        "own_speed: column 'w' of table 'data' holds '' in line 3, must hold numbers: correct the line, or remove it",
    ),
    "a value out of range in a column": (
        (SPEED, 'own_speed = {table = "data", column = "v"}' + DATA),
        "own_speed: column 'v' of table 'data' holds 70 in line 3, must be -50 to 50: remove the line, or convert",
    ),
    "an unknown word in a column": (
        (SPEED, 'side = {table = "data", column = "word"}' + DATA),
        "[encounter] side: column 'word' of table 'data' holds 'left': known: port, starboard",
    ),
    "an unknown ship in a column": (
        (SHIPS, 'ships = {table = "data", column = "ship"}' + DATA), "[own] ships: titanic: unknown ship 'titanic'",
    ),
    "a weight below 0": (
        (SPEED, DATA + '\nweight = "w"'), "[tables.data] weight = 'w' is -1 in line 3, must be at least 0: correct the",
    ),
    "weights of lines that are all 0": (
        (SPEED, '[tables.data]\nfile = "zero.csv"\nweight = "w"'),
        "[tables.data] weight = 'w' is 0 in all 2 lines, must be above 0 in one at least: correct it, or leave",
    ),
    "weights that are words": (
        (SPEED, DATA + '\nweight = "word"'), "[tables.data] weight = 'word' is 'port' in line 2, must be a number of",
    ),
    "a weight that is no column": ((SPEED, DATA + '\nweight = "x"'), "[tables.data] weight = 'x' is no column: known:"),
    "a table without lines": (
        (SPEED, '[tables.data]\nfile = "empty.csv"'), "file = 'empty.csv' has 0 lines below its names, must have 1 to",
    ),
    "a table without names": (
        (SPEED, '[tables.data]\nfile = "none.csv"'),
        "file = 'none.csv' is empty: give a file with a line of column names at its top",
    ),
    "a column twice": (
        (SPEED, '[tables.data]\nfile = "twice.csv"'),
        "file = 'twice.csv' has the column name 'a' twice in line 1: give each column a name of its own",
    ),
    "a column without a name": (
        (SPEED, '[tables.data]\nfile = "unnamed.csv"'), "file = 'unnamed.csv' has no name for column 2 in line 1: give",
    ),
    "a table with semicolons": (
        (SPEED, '[tables.data]\nfile = "semi.csv"'),
        "file = 'semi.csv' is separated by semicolons: save it with commas between values and points in numbers",
    ),
    "a table with tabs": (
        (SPEED, '[tables.data]\nfile = "tabs.csv"'), "file = 'tabs.csv' is separated by tabs: save it with commas",
    ),
    "a line cut short": (
        (SPEED, '[tables.data]\nfile = "short.csv"'),
        "file = 'short.csv' line 3 has 1 values, must have 2 as its first line: complete it",
    ),
    "a number that is not finite": (
        (SPEED, '[tables.data]\nfile = "nan.csv"'), "file = 'nan.csv' column 'b' line 2 is nan, must be finite: remove",
    ),
    "Parquet that is none": (
        (SPEED, '[tables.data]\nfile = "cut.parquet"'), "file = 'cut.parquet' is not Parquet: ",
    ),
    "too many dimensions": (
        (GOOD, GOOD.replace("rows = 100", 'rows = 64\nsampler = "sobol"') + MANY),
        "[study] sampler = 'sobol' has 32 dimensions, and 33 variables, ships and tables are drawn: take latin-hyper",
    ),
    "a sailed ship that goes astern": (
        (END, END.replace("impact", "sailed").replace("2.0", "-2.0")),
        '[encounter] own_speed goes down to -2, must be at least 0 at level = "sailed": change least',
    ),
    "a sailed ship that only coasts": (
        (END, END.replace("impact", "sailed").replace("kcs", "guan2014_own")),
        "[own] ships: guan2014_own can only coast, it has no [manoeuvring]: take level = \"encounter\", or another",
    ),
    "a kind of another level in a column": (
        (SPEED, 'kind = {table = "data", column = "kind"}' + DATA.replace("data.csv", "kinds.csv")),
        '[encounter] kind = "late-evasive" needs ships that steer: take level = "sailed", or another kind',
    ),
    # -- [situations]
    "situations without motion": (
        (SPEED, '[situations]\nfolder = "."'), '[situations] needs ships that move: take level = "encounter" or "sail',
    ),
    "a folder that is not there": (
        (END, SAILED + '[situations]\nfolder = "no"'),
        "[situations] folder = 'no' cannot be read in ",
    ),
    "a folder without situations": (
        (END, SAILED + '[situations]\nfolder = "."'),
        "[situations] folder = '.' holds 0 files *.json and *.xml, must hold 1 to 100000: give a folder of situations",
    ),
    "a kind beside situations": (
        (END, BESIDE + 'kind = "t-bone"'),
        "kind has no effect with [situations]: remove it",
    ),
    "an angle beside situations": (
        (END, BESIDE + 'angle_deg = 30.0'),
        "[encounter] angle_deg has no effect with [situations]: remove it",
    ),
    "a current without a direction": (
        (END, BESIDE + 'current_speed = 1.0'),
        "[encounter] current_towards_deg is missing: a current has a speed and a direction",
    ),
    "a wind without a speed": (
        (END, SAILED + "[encounter]\nwind_from_deg = 1.0"),
        "[encounter] wind_speed is missing: a wind has a speed and a direction",
    ),
    "a wind on coasting ships": (
        (END, SAILED.replace("sailed", "encounter") + "[encounter]\nwind_speed = 9.0\nwind_from_deg = 1.0"),
        '[encounter] wind_speed has no effect at level = "encounter": remove it, or take level = "sailed"',
    ),
    "a current at an impact": (
        (SPEED, "current_speed = 1.0\ncurrent_towards_deg = 2.0"),
        '[encounter] current_speed has no effect at level = "impact": remove it, or take level = "sailed"',
    ),
    "a current that carries a drifting target": (
        (END, SAILED + '[encounter]\nkind = "drifting-target"\ncurrent_speed = 1.0\ncurrent_towards_deg = 1.0'),
        '[encounter] current_speed has no effect with kind "drifting-target": remove it, or take kind head-on or',
    ),
    # -- other files
    "no TOML": (("[own]", "[own"), "is not valid TOML: "),
    "a scenario": ((GOOD, '[scenario]\nname = "a"'), "is a scenario, not a study: give a study, which has a table"),
    "a ship": ((GOOD, "[particulars]\nL_pp = 3.0"), "is a ship, not a study: give a study, which has a table [study]"),
}  # fmt: skip


@pytest.mark.parametrize("name", REFUSALS)
def test_a_bad_study_is_refused_in_one_line(name: str, tmp_path: Path) -> None:
    (old, new), message = REFUSALS[name]
    assert old in GOOD
    for file, text in {
        **TABLES, "empty.csv": "a,b\n", "none.csv": "", "short.csv": "a,b\n1,2\n3\n", "nan.csv": "a,b\n1,nan\n",
        "kinds.csv": "kind\nt-bone\nlate-evasive\n", "good.csv": "a\n1\n", "gap.csv": "w\n5\n \n",
        "zero.csv": "w\n0\n0\n", "twice.csv": "a,b,a\n1,2,3\n", "unnamed.csv": "a, \n1,2\n",
        "semi.csv": "v;w\n6,5;5,5\n", "tabs.csv": "v\tw\n6.5\t5.5\n",
        "cut.parquet": "PAR1 and no more",
    }.items():  # fmt: skip
        (tmp_path / file).write_text(text)
    with pytest.raises(StudyError, match=re.escape(message)) as refusal:
        parse_study(GOOD.replace(old, new), "mine.toml", tmp_path)
    line = str(refusal.value)
    assert line.startswith("mine.toml")
    assert "\n" not in line


def test_a_ship_file_is_looked_for_beside_the_study_alone(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A file of the same name where the study happens to be run is another ship."""
    (tmp_path / "here").mkdir()
    (tmp_path / "study").mkdir()
    for name in ("here/coaster.toml", "study/coasters.toml"):
        (tmp_path / name).write_text('extends = "kcs"\n')
    monkeypatch.chdir(tmp_path / "here")
    text = GOOD.replace(SHIPS, 'ships = ["coaster.toml"]')
    with pytest.raises(StudyError, match=r"coaster\.toml: no such file in .*study.* did you mean coasters\.toml\?"):
        parse_study(text, "mine.toml", tmp_path / "study")


def test_the_good_study_is_read(tmp_path: Path) -> None:
    """Each refusal above is due to its own change."""
    assert parse_study(GOOD, "mine.toml", tmp_path).rows == 100
    assert parse_study(GOOD.replace(SHIPS, POOL), "mine.toml", tmp_path).own.size == 100


def test_ships_and_pools_of_weight_0_are_never_chosen(tmp_path: Path) -> None:
    """Whichever comes first or last."""
    shares = np.linspace(1e-9, 1.0 - 1e-9, 1001)
    for ships, weight, chosen in ((f"{SHIPS}\n", 0, {0}), ("ships = {kcs = 0, kvlcc2 = 0}\n", 1, set(range(2, 102)))):
        fleet = parse_study(GOOD.replace(SHIPS, f"{ships}{POOL}\nweight = {weight}"), "mine.toml", tmp_path).own
        assert set(fleet.choose(shares).tolist()) == chosen


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ("quik", "unknown study 'quik': did you mean quick? Else give the path of a TOML file"),
        (
            "my/study.toml",
            "study file my/study.toml does not exist: give the path of a TOML file or one of",
        ),
        (
            "traffic.csv",
            "traffic.csv is no TOML file: give a study file, NAME.toml, or one of closed_forms, million, qui",
        ),
        ("", "study = '' is no study: give a name or the path of a TOML file"),
        ("./", "./ is a folder: give the path of a study file, or one of closed_forms, million, quick"),
    ],
)
def test_a_study_that_is_not_there_is_refused(given: str, message: str) -> None:
    with pytest.raises(StudyError, match=re.escape(message)):
        read_study(given)


def test_text_that_is_not_utf8_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "latin.toml"
    path.write_bytes(b'[study]\nname = "\xe9"')
    with pytest.raises(StudyError, match=r"latin.toml is not UTF-8 text \(byte 16\): save it as UTF-8"):
        read_study(path)
