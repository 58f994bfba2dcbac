"""Analyses a corpus with `drystone batch` on Ray Data, and writes the results as Parquet.

    pip install "ray[data]" pyarrow
    python3 examples/cluster/corpus.py 1000000 > corpus.ndjson
    python3 examples/cluster/ray_data.py corpus.ndjson answers.parquet --drystone target/release/drystone

The corpus is divided into parts at the ends of lines. For each part, one process of drystone analyses the lines and
writes one result for each line. If a process or its worker fails, results are missing: the task of the part fails, and
Ray runs the task again from the start. In the end, every scene has exactly one result. To test this, --kill N kills N
of the processes while they work. The corpus must be in a folder that every machine can read.
"""

import argparse
import json
import os
import pathlib
import random
import signal
import subprocess
import tempfile
import threading
import time

import pyarrow as pa
import pyarrow.compute as pc
import pyarrow.parquet as pq
import ray


def parts(corpus, lines_each):
    """Returns a dict for each part of the file.

    `first` is the number of the first line of the part, from 1; `offset` and `length` are in bytes; `lines` is the
    number of lines of the part.
    """
    found = []
    with open(corpus, "rb") as file:
        first, offset, count, length = 1, 0, 0, 0
        for line in file:
            count += 1
            length += len(line)
            if count == lines_each:
                found.append({"first": first, "offset": offset, "length": length, "lines": count})
                first, offset, count, length = first + count, offset + length, 0, 0
        if count:
            found.append({"first": first, "offset": offset, "length": length, "lines": count})
    return found


def analysed(corpus, binary, fields, pids):
    """Returns a function for map_batches that converts a part to a table with one row per line."""

    def part(batch):
        first, offset, length, lines = (int(batch[key][0]) for key in ("first", "offset", "length", "lines"))
        with open(corpus, "rb") as file:
            file.seek(offset)
            text = file.read(length)
        process = subprocess.Popen(
            [binary, "batch", "--jobs", "1", "--quiet", "--fields", fields],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
        )
        mark = pathlib.Path(pids) / str(process.pid)
        mark.touch()
        output, _ = process.communicate(text)
        mark.unlink(missing_ok=True)
        answers = [json.loads(line) for line in output.splitlines() if line.endswith(b"}")]
        # Exit codes 0 to 3 depend on the verdicts. With any other exit code, results of this part are missing.
        if process.returncode not in (0, 1, 2, 3) or len(answers) != lines:
            raise RuntimeError(f"drystone ended with {process.returncode} after {len(answers)} of {lines} lines")
        # A key with a list or an object is a column of JSON texts. All parts have the same columns.
        keys = dict.fromkeys([*(field.split(".")[0] for field in fields.split(",")), "problems"])
        values = {key: [answer.get(key) for answer in answers] for key in keys}
        text = {key: [v if v is None or isinstance(v, str) else json.dumps(v) for v in values[key]] for key in keys}
        columns = {key: pa.array(column, pa.string()) for key, column in text.items()}
        return pa.table({"number": pa.array(range(first, first + lines), pa.int64()), **columns})

    return part


def kill_some(pids, count, after, ended):
    """Kills `count` of the processes of drystone while they run, one every `after` seconds, until the event `ended`.

    `pids` is a folder with a file for each running process, whose name is the id of the process.
    """
    killed = 0
    while killed < count and not ended.wait(after):
        marks = list(pathlib.Path(pids).iterdir())
        if marks:
            mark = random.choice(marks)
            try:
                os.kill(int(mark.name), signal.SIGKILL)
            except ProcessLookupError:
                continue
            killed += 1
            print(f"killed process {mark.name}", flush=True)


def main():
    arguments = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    arguments.add_argument("corpus")
    arguments.add_argument("parquet")
    arguments.add_argument("--drystone", default="drystone")
    arguments.add_argument("--fields", default="scene,verdict")
    arguments.add_argument("--lines", type=int, default=20_000, help="in a part")
    arguments.add_argument("--attempts", type=int, default=4)
    arguments.add_argument("--kill", type=int, default=0, metavar="N")
    arguments.add_argument("--after", type=float, default=5.0, metavar="SECONDS")
    options = arguments.parse_args()
    corpus = os.path.abspath(options.corpus)
    binary = options.drystone if os.sep not in options.drystone else os.path.abspath(options.drystone)
    ray.init(include_dashboard=False, log_to_driver=False)
    start = time.perf_counter()
    with tempfile.TemporaryDirectory() as pids:
        ended = threading.Event()
        killer = threading.Thread(target=kill_some, args=(pids, options.kill, options.after, ended), daemon=True)
        killer.start()
        all_parts = parts(corpus, options.lines)
        scenes = sum(part["lines"] for part in all_parts)
        answers = ray.data.from_items(all_parts, override_num_blocks=len(all_parts)).map_batches(
            analysed(corpus, binary, options.fields, pids),
            batch_size=1,
            max_retries=options.attempts,
            retry_exceptions=True,
        )
        answers.write_parquet(options.parquet, mode="overwrite")
        ended.set()
        killer.join()
    seconds = time.perf_counter() - start

    table = pq.read_table(options.parquet)
    numbers = table["number"]
    found = (table.num_rows, pc.count_distinct(numbers).as_py(), pc.max(numbers).as_py())
    assert found == (scenes, scenes, scenes), f"{scenes} scenes, but {found}"
    print(f"{scenes} scenes, each answered once, in {seconds:.0f} s: {scenes / seconds:.0f} a second")
    if "verdict" in table.column_names:
        print(table.group_by("verdict").aggregate([("number", "count")]).to_pandas().to_string(index=False))
    ray.shutdown()


if __name__ == "__main__":
    main()
