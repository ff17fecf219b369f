"""run_study() in one process: what it writes, and what it finds there when it goes on."""

from __future__ import annotations

import json
import pickle
import resource
import shutil
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pyarrow.parquet as pq
import pytest
from distributed import KilledWorker

from shipcollision_fmu import __version__
from shipcollision_fmu.cosim.folder_lock import hold_folder
from shipcollision_fmu.errors import HostError, StudyError
from shipcollision_fmu.files import write_files
from shipcollision_fmu.study.engine.assembly import Assembly
from shipcollision_fmu.study.engine.batches import Batch, BatchPlan
from shipcollision_fmu.study.engine.dask_executor import DaskExecutor, _SchedulerLostError
from shipcollision_fmu.study.engine.executor import Failure, Outcome
from shipcollision_fmu.study.engine.folder import StudyFolder
from shipcollision_fmu.study.engine.loop import Loop, Tally
from shipcollision_fmu.study.engine.part_file import PartBytes
from shipcollision_fmu.study.engine.parts import get_part, list_parts
from shipcollision_fmu.study.engine.run import StudyResult, run_study
from shipcollision_fmu.study.engine.work import compute_batch
from tests.study.engine.folders import STUDY, digest, list_files
from tests.study.engine.stand_in import StandIn, Tables, compute_stand_in

FIRST = "part-000000000000-000000000199.parquet"


def run(out: Path, study: StandIn = STUDY, **options: object) -> StudyResult:
    return run_study(study, out, workers=0, engine="python", compute=compute_stand_in, **options)  # type: ignore[arg-type]


def test_each_row_is_there_once_and_in_order(whole: Path) -> None:
    rows = [row for file in sorted((whole / "encounters").iterdir()) for row in pq.read_table(file)["row"].to_pylist()]
    assert rows == list(range(STUDY.rows))
    owners = [
        row for file in sorted((whole / "collisions").iterdir()) for row in pq.read_table(file)["row"].to_pylist()
    ]
    assert owners == [row for row in range(STUDY.rows) if row % 7 for _ in range(row % 3)]


def test_the_tables_are_those_of_the_study(whole: Path) -> None:
    expected = compute_stand_in(STUDY, 200, 200, "python")
    for name in ("encounters", "collisions"):
        found = pq.read_table(whole / name / "part-000000000200-000000000399.parquet")
        assert found.equals(getattr(expected, name))


def test_units_and_meanings_are_in_the_schema(whole: Path) -> None:
    field = pq.read_schema(whole / "encounters" / FIRST).field("energy")
    assert (field.metadata[b"unit"], field.metadata[b"meaning"]) == (b"J", b"energy lost")


def test_study_file_versions_and_counts_are_beside_the_tables(whole: Path) -> None:
    assert (whole / "study.toml").read_text(encoding="utf-8") == STUDY.text
    content = json.loads((whole / "study.json").read_text(encoding="utf-8"))
    refused = len(range(0, 1010, 7))
    collisions = sum(row % 3 for row in range(1010) if row % 7)
    assert content["counts"] == {"rows": 1010, "refused": refused, "collisions": collisions, "contact_at_end": 0}
    assert (content["status"], content["parts"], content["level"]) == ("complete", 6, "sailed")
    assert content["fingerprint"] == STUDY.fingerprint
    assert content["versions"]["shipcollision_fmu"] == __version__
    assert content["versions"].keys() >= {"python", "numpy", "pyarrow", "dask", "distributed"}


def test_a_study_without_rows_of_a_kind_has_its_tables(tmp_path: Path) -> None:
    result = run(tmp_path / "one", StandIn(rows=1))  # row 0 is refused
    assert (result.rows, result.refused, result.collisions) == (1, 1, 0)
    assert pq.read_table(next((tmp_path / "one" / "collisions").iterdir())).num_rows == 0


def test_batches_of_other_sizes_give_the_same_bytes(
    whole: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    for first in (1, 7, 200):
        monkeypatch.setattr("shipcollision_fmu.study.engine.batches.FIRST_ROWS", first)
        monkeypatch.setattr("shipcollision_fmu.study.engine.batches.TARGET", 1e-3 * first)
        run(tmp_path / str(first))
        assert digest(tmp_path / str(first)) == digest(whole)


class Stop:
    """Interrupts a study at its n-th call."""

    def __init__(self, calls: int) -> None:
        self._left = calls

    def __call__(self, *arguments: object) -> None:
        self._left -= 1
        if self._left == 0:
            raise KeyboardInterrupt


@pytest.mark.parametrize("calls", [1, 2, 4])
def test_an_interrupted_study_goes_on_to_the_same_bytes(whole: Path, tmp_path: Path, calls: int) -> None:
    out = tmp_path / "study"
    stop = Stop(calls)

    def compute(study: StandIn, first: int, count: int, engine: str) -> Tables:
        if first % 200 == 0:
            stop()
        return compute_stand_in(study, first, count, engine)

    text = rf"^interrupted; {200 * (calls - 1)} of 1010 rows are in {out}: go on with --resume$"
    with pytest.raises(KeyboardInterrupt, match=text):
        run_study(STUDY, out, workers=0, engine="python", compute=compute)
    assert json.loads((out / "study.json").read_text(encoding="utf-8"))["status"] == "interrupted"
    assert len(list((out / "encounters").glob("*"))) == calls - 1
    result = run(out, resume=True)
    assert (result.rows, result.computed) == (1010, 1010 - 200 * (calls - 1))
    assert digest(out) == digest(whole)


def test_a_client_that_is_killed_between_both_files_of_a_part(
    whole: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    out = tmp_path / "study"

    class KilledError(BaseException):
        pass

    def die(folder: Path, files: dict[str, bytes], remedy: str) -> None:
        (folder / ".shipcollision-x").mkdir(parents=True, exist_ok=True)
        (folder / ".shipcollision-x" / "half.parquet").write_bytes(b"PAR1")
        if folder.name == "encounters":
            raise KilledError
        write_files(folder, files, remedy)

    monkeypatch.setattr("shipcollision_fmu.study.engine.folder.write_files", die)
    with pytest.raises(KilledError):
        run(out)
    monkeypatch.undo()
    assert [path.name for path in (out / "collisions").iterdir() if path.is_file()] == [FIRST]
    run(out, resume=True)
    assert digest(out) == digest(whole)
    assert list_files(out) == list_files(whole)


@pytest.mark.parametrize("table", ["encounters", "collisions"])
@pytest.mark.parametrize("damage", ["cut", "empty", "other"])
def test_a_damaged_file_is_computed_again_with_a_line(whole: Path, tmp_path: Path, table: str, damage: str) -> None:
    out = tmp_path / "study"
    shutil.copytree(whole, out)
    file = out / table / FIRST
    if damage == "other":
        run(tmp_path / "other", replace(STUDY, seed=2))
        shutil.copy(tmp_path / "other" / table / FIRST, file)
    else:
        file.write_bytes(file.read_bytes()[: 300 if damage == "cut" else 0])
    lines: list[str] = []
    result = run(out, resume=True, notify=lines.append)
    assert lines == [f"{file} is cut short or no file of this study: its rows are computed again"]
    assert result.computed == 200
    assert digest(out) == digest(whole)


def test_a_finished_study_is_not_computed_again(whole: Path, tmp_path: Path) -> None:
    out = tmp_path / "study"
    shutil.copytree(whole, out)
    assert run(out, resume=True).computed == 0
    with pytest.raises(
        StudyError, match=rf"^{out} holds a study already: go on with it with --resume, or give another"
    ):
        run(out)
    assert digest(out) == digest(whole)


def test_a_finished_study_asks_no_scheduler(whole: Path, tmp_path: Path) -> None:
    """Nothing listens at the address; a cluster of one's own would take seconds to start."""
    out = tmp_path / "study"
    shutil.copytree(whole, out)
    result = run_study(
        STUDY, out, scheduler="tcp://127.0.0.1:9", resume=True, engine="python", compute=compute_stand_in
    )  # type: ignore[arg-type]  # a stand-in
    assert (result.rows, result.computed) == (STUDY.rows, 0)


@pytest.mark.parametrize("resume", [False, True])
def test_a_folder_that_another_run_writes_is_left_alone(tmp_path: Path, resume: bool) -> None:
    """Two studies that begin at the same moment would be mixed."""
    out = tmp_path / "studies" / "one"
    with hold_folder(out):
        with pytest.raises(HostError, match=rf"^{out} is being written by another run: wait until it has"):
            run(out, resume=resume)
        assert list(out.iterdir()) == []
    assert list(tmp_path.iterdir()) == []
    assert run(out, resume=resume).rows == STUDY.rows


def test_a_study_that_ends_by_a_fault_is_not_said_to_run(tmp_path: Path) -> None:
    def compute(study: StandIn, first: int, count: int, engine: str) -> Tables:
        if first >= 200:
            raise HostError("the disk is full")
        return compute_stand_in(study, first, count, engine)

    with pytest.raises(HostError, match=r"^the disk is full$"):
        run_study(STUDY, tmp_path / "one", workers=0, engine="python", compute=compute)  # type: ignore[arg-type]
    content = json.loads((tmp_path / "one" / "study.json").read_text(encoding="utf-8"))
    assert (content["status"], content["counts"]["rows"]) == ("interrupted", 200)


def test_resume_without_a_study_begins_it(whole: Path, tmp_path: Path) -> None:
    """A job script gives --resume always."""
    run(tmp_path / "new", resume=True)
    assert digest(tmp_path / "new") == digest(whole)


@pytest.mark.parametrize("resume", [False, True])
def test_a_folder_of_other_origin_is_left_alone(tmp_path: Path, resume: bool) -> None:
    (tmp_path / "thesis.tex").write_text("years", encoding="utf-8")
    (tmp_path / "study.json").write_text("[]", encoding="utf-8")
    with pytest.raises(
        HostError, match=rf"^{tmp_path} holds study.json and others, and no study.json of a study: give"
    ):
        run(tmp_path, resume=resume)
    assert list_files(tmp_path) == ["study.json", "thesis.tex"]


def test_a_folder_of_another_study_is_left_alone(whole: Path, tmp_path: Path) -> None:
    out = tmp_path / "study"
    shutil.copytree(whole, out)
    before = {path: (out / path).read_bytes() for path in list_files(out)}
    with pytest.raises(
        StudyError, match=r"holds another study: changed since: seed \(was 1, is 2\); give a new folder with --out"
    ):
        run(out, replace(STUDY, seed=2), resume=True)
    assert {path: (out / path).read_bytes() for path in list_files(out)} == before
    content = json.loads((out / "study.json").read_text(encoding="utf-8"))
    content["versions"]["shipcollision_fmu"], content["fingerprint"] = "0.0.9", "of 0.0.9"
    (out / "study.json").write_text(json.dumps(content), encoding="utf-8")
    with pytest.raises(
        StudyError, match=rf"it was begun by version 0\.0\.9 of shipcollision-fmu, this is {__version__}"
    ):
        run(out, resume=True)


def test_a_full_disk_leaves_whole_files_and_goes_on_with_room(whole: Path, tmp_path: Path) -> None:
    """A limit of the size of files stands for it: the system refuses to write beyond."""
    out = tmp_path / "study"
    sizes = sorted(path.stat().st_size for path in whole.rglob("*.parquet"))
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (sizes[-1] - 1, before[1]))
    try:
        with pytest.raises(
            HostError, match=rf"^cannot write to {out}/\w+: File too large; make room on the disk, or its"
        ):
            run(out)
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, before)
    assert all(pq.read_metadata(path).num_rows for path in out.rglob("*.parquet"))
    assert not [path for path in list_files(out) if ".shipcollision" in path]
    run(out, resume=True)
    assert digest(out) == digest(whole)


def test_an_unwritable_folder_is_refused_before_anything_is_computed(tmp_path: Path) -> None:
    (tmp_path / "file").touch()
    with pytest.raises(HostError, match=f"cannot write to {tmp_path}/file/study: {tmp_path}/file is not a folder"):
        run(tmp_path / "file" / "study")


def test_csv_has_the_same_rows(whole: Path, tmp_path: Path) -> None:
    out = tmp_path / "study"
    run(out, csv=True)
    lines = (out / "encounters.csv").read_text(encoding="utf-8").splitlines()
    assert len(lines) == 1 + STUDY.rows
    assert lines[:2] == ['"row","status","reason","energy"', '0,"refused","row 0 is refused",']
    energy = float(lines[2].split(",")[3])
    assert energy == pq.read_table(whole / "encounters" / FIRST)["energy"][1].as_py()
    assert len((out / "collisions.csv").read_text(encoding="utf-8").splitlines()) == 1 + sum(
        row % 3 for row in range(1010) if row % 7
    )


def test_an_interrupt_while_csv_is_written_says_that_all_rows_are_there(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def interrupt(*arguments: object) -> None:
        raise KeyboardInterrupt

    out = tmp_path / "study"
    monkeypatch.setattr("shipcollision_fmu.study.engine.csv_tables.pq.read_table", interrupt)
    with pytest.raises(
        KeyboardInterrupt, match=f"^interrupted; 1010 of 1010 rows are in {out}: go on with --resume --csv$"
    ):
        run(out, csv=True)
    assert [path.name for path in out.glob(".shipcollision-*")] == []
    monkeypatch.undo()
    run(out, resume=True, csv=True)
    assert len((out / "encounters.csv").read_text(encoding="utf-8").splitlines()) == 1 + STUDY.rows


def test_a_csv_that_a_killed_client_has_begun_is_removed(tmp_path: Path) -> None:
    out = tmp_path / "study"
    run(out)
    (out / ".shipcollision-encounters.csv").write_text("row")
    run(out, resume=True)
    assert list(out.glob(".shipcollision-*")) == []


def test_progress_counts_rows_and_begins_with_those_that_are_there(tmp_path: Path) -> None:
    seen: list[tuple[int, int]] = []

    def stop(done: int, rows: int) -> None:
        seen.append((done, rows))
        if done >= 400:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        run(tmp_path / "study", progress=stop)
    assert seen[0] == (0, 1010)
    again: list[tuple[int, int]] = []
    run(tmp_path / "study", resume=True, progress=lambda done, rows: again.append((done, rows)))
    assert again[0] == (400, 1010)
    assert again[-1] == (1010, 1010)
    assert [done for done, _ in again] == sorted(done for done, _ in again)


def test_rows_that_are_lost_or_doubled_are_a_fault(tmp_path: Path) -> None:
    def lose(study: StandIn, first: int, count: int, engine: str) -> Tables:
        return compute_stand_in(study, first, count - 1, engine)

    def double(study: StandIn, first: int, count: int, engine: str) -> Tables:
        return compute_stand_in(study, max(0, first - 1), count, engine)

    for number, compute in enumerate((lose, double)):
        with pytest.raises(RuntimeError, match=r"^rows \d+ to \d+ were computed as \d+ other rows$"):
            run_study(STUDY, tmp_path / str(number), workers=0, engine="python", compute=compute)
        assert list((tmp_path / str(number) / "encounters").glob("*")) in ([], [tmp_path / "1" / "encounters" / FIRST])


def test_a_worker_with_the_disk_of_the_study_writes_a_whole_part_itself(whole: Path, tmp_path: Path) -> None:
    """Its answer then stays small, and the client moves the same bytes into place."""
    part = get_part(0, STUDY.rows, STUDY.level)
    folder = StudyFolder(tmp_path / "study", STUDY)
    folder.check(False, lambda _: "python")
    folder.open()
    answer = compute_batch(STUDY, compute_stand_in, "python", Batch(part, part.first, part.count), aside=folder.aside)
    assert len(pickle.dumps(answer)) < 2_000 < (whole / "encounters" / FIRST).stat().st_size
    assert answer.part is not None
    folder.write(answer.part)
    folder.close()
    assert list_files(folder.path) == sorted([f"collisions/{FIRST}", f"encounters/{FIRST}", "study.json", "study.toml"])
    for table in ("collisions", "encounters"):
        assert (folder.path / table / FIRST).read_bytes() == (whole / table / FIRST).read_bytes()


def test_memory_of_the_client_holds_one_part(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Parts are written as they are complete: none waits for the end."""
    written: list[int] = []
    write = StudyFolder.write

    def keep(self: StudyFolder, part: PartBytes) -> None:
        written.append(part.part.number)
        write(self, part)

    monkeypatch.setattr(StudyFolder, "write", keep)
    begun: list[int] = []

    def compute(study: StandIn, first: int, count: int, engine: str) -> Tables:
        begun.append(first // 200)
        assert begun[-1] - len(written) <= 0
        return compute_stand_in(study, first, count, engine)

    run_study(STUDY, tmp_path / "study", workers=0, engine="python", compute=compute)
    assert written == [0, 1, 2, 3, 4, 5]


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (
            {"scheduler": "tcp://127.0.0.1:1", "scheduler_file": "s.json"},
            "give --scheduler or --scheduler-file, not both",
        ),
        ({"scheduler": "tcp://127.0.0.1:1", "workers": 2}, "a cluster that exists has its own workers: leave out"),
        ({"workers": -1}, "--workers -1 must be 0 or more"),
    ],
)
def test_options_that_do_not_go_together(tmp_path: Path, options: dict[str, object], message: str) -> None:
    with pytest.raises(StudyError, match=message):
        run_study(STUDY, tmp_path / "study", engine="python", compute=compute_stand_in, **options)  # type: ignore[arg-type]
    assert not (tmp_path / "study").exists()


def test_a_batch_that_is_too_much_is_halved_down_to_what_can_be_borne(whole: Path, tmp_path: Path) -> None:
    run(tmp_path / "study", replace(STUDY, deadly=450, bearable=3, is_killed=False))
    assert digest(tmp_path / "study") == digest(whole)


def test_a_row_that_cannot_be_borne_is_named_and_the_rest_is_kept(whole: Path, tmp_path: Path) -> None:
    out = tmp_path / "study"
    with pytest.raises(HostError, match=r"^row 450 ended one worker after the other, killed or out of memory"):
        run(out, replace(STUDY, deadly=450, is_killed=False))
    assert digest(out).items() <= digest(whole).items()
    run(out, resume=True)  # with more memory
    assert digest(out) == digest(whole)


class SlowDeath:
    """An executor whose rows end their workers, after a while in which nothing comes back."""

    most = 4

    def __init__(self) -> None:
        self.out: list[Batch] = []
        self.calls = 0

    def submit(self, batch: Batch) -> None:
        assert not any(other.count == 1 and self.calls > 8 for other in self.out), "a suspect is not alone"
        self.out.append(batch)

    def collect(self, check: Callable[[], None]) -> list[Outcome]:
        self.calls += 1
        assert self.calls < 40, "it goes round and round"
        return [] if self.calls % 4 else [Outcome(self.out.pop(0), failure=Failure.DEADLY) for _ in list(self.out)]


def test_a_row_that_takes_long_to_end_its_worker_is_named_as_well(tmp_path: Path) -> None:
    study = StandIn(rows=2)
    folder = StudyFolder(tmp_path / "study", study)
    plan = BatchPlan(list_parts(2, "sailed"))
    loop = Loop(SlowDeath(), plan, Assembly(study.fingerprint), folder, Tally(), 2, None)
    with pytest.raises(HostError, match=r"^row 0 ended one worker after the other, killed or out of memory"):
        loop.run(lambda: None)


def test_a_worker_of_another_version_computes_nothing(tmp_path: Path) -> None:
    batch = Batch(get_part(0, 10, "sailed"), 0, 10)
    with pytest.raises(HostError, match=rf"^a worker has shipcollision-fmu {__version__}, the client has 9\.9\.9"):
        compute_batch(STUDY, compute_stand_in, "python", batch, version="9.9.9")


def test_a_worker_that_lacks_a_package_is_named_with_the_remedy() -> None:
    class Failed:
        def exception(self, timeout: float) -> BaseException:
            return ModuleNotFoundError("No module named 'shipcollision_fmu'", name="shipcollision_fmu")

    executor, batch = object.__new__(DaskExecutor), Batch(get_part(0, 10, "sailed"), 0, 10)
    with pytest.raises(HostError, match=r"^a worker has no package 'shipcollision_fmu': run `python -m pip install '"):
        executor._explain(batch, Failed())  # type: ignore[arg-type]


class Done:
    """A future of Dask in a state."""

    def __init__(self, status: str) -> None:
        self.status = status

    def exception(self, timeout: float) -> BaseException:
        """That of a batch that has ended its workers."""
        return MemoryError()


def test_a_batch_that_failed_as_the_scheduler_went_away_is_not_lost() -> None:
    """Both come at once: what failed is still out, and comes back with the others."""
    executor = object.__new__(DaskExecutor)
    part = get_part(0, 10, "sailed")
    failed, lost = Done("error"), Done("lost")
    executor._out = {failed: Batch(part, 0, 5), lost: Batch(part, 5, 5)}  # type: ignore[dict-item]
    with pytest.raises(_SchedulerLostError):
        executor._take([failed, lost], lambda: None)  # type: ignore[list-item]
    assert sorted(batch.first for batch in executor._out.values()) == [0, 5]


def test_an_answer_whose_second_computation_ends_its_workers_is_a_failure(monkeypatch: pytest.MonkeyPatch) -> None:
    """Dask computes an answer again whose worker went away before it was fetched."""
    executor = object.__new__(DaskExecutor)
    future, batch = Done("finished"), Batch(get_part(0, 10, "sailed"), 0, 10)
    executor._out = {future: batch}  # type: ignore[dict-item]

    def gather(finished: list[Done], check: Callable[[], None]) -> list[object]:
        if finished:
            future.status = "error"
            raise KilledWorker("key", "worker", 3)
        return []

    monkeypatch.setattr(executor, "_gather", gather)
    assert executor._take([future], lambda: None) == [Outcome(batch, failure=Failure.DEADLY)]  # type: ignore[list-item]
    assert executor._out == {}
