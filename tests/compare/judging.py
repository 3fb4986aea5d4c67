"""What the tests of traces share: calls of the command and of the checker, records in files, traces to spoil."""
import contextlib
import io
import json
import subprocess
import sys
from pathlib import Path

import check_trace

CHECKER = (sys.executable, "-B", Path(__file__).with_name("check_trace.py"))


def check(*arguments):
    """As `call`. In this process: to start another takes longer than to check a short trace."""
    said, errors = io.StringIO(), io.StringIO()
    with contextlib.redirect_stdout(said), contextlib.redirect_stderr(errors):
        status = check_trace.main(list(map(str, arguments)))
    return status, said.getvalue(), errors.getvalue()


def call(*arguments):
    """Exit status, output, errors."""
    if arguments[:len(CHECKER)] == CHECKER:
        return check(*arguments[len(CHECKER):])
    done = subprocess.run(arguments, capture_output=True, text=True, check=False)
    return done.returncode, done.stdout, done.stderr


def read(path):
    """The header, or what rows have for one, and the records."""
    return [json.loads(line) for line in Path(path).read_text(encoding="utf-8").splitlines()]


def write(path, records):
    Path(path).write_text("".join(json.dumps(record) + "\n" for record in records), encoding="utf-8")


def compare(command, *arguments, only="octagon_sweep"):
    return call(command, "compare", *arguments, "--contender", only, "--no-reference", "--no-timing", "--quiet")


def traces_of(command, folder, *scenes):
    """The files that octagon_sweep in double writes, by the scenes' names."""
    status, _, errors = compare(command, *scenes, "--trace", Path(folder) / "t")
    assert status == 0, errors
    return {Path(scene).stem: Path(folder) / f"t.{Path(scene).stem}.octagon_sweep.double.jsonl" for scene in scenes}
