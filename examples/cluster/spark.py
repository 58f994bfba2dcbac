"""Analyses a corpus with `drystone batch` on Spark, and writes the results as Parquet.

    pip install pyspark pyarrow && apt-get install default-jre-headless
    python3 examples/cluster/corpus.py 1000000 > corpus.ndjson
    python3 examples/cluster/spark.py corpus.ndjson answers.parquet --drystone target/release/drystone

The lines of the corpus are divided into partitions. For each partition, one process of drystone analyses the lines and
writes one result for each line. If a process or its machine fails, results are missing: the task of the partition
fails, and Spark runs the task again from the start. In the end, every scene has exactly one result. To test this,
--kill N kills N of the processes while they work.
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

from pyspark.sql import Row, SparkSession


def analysed(binary, fields, pids):
    """Returns a function for mapPartitions that converts pairs (number, line) to rows, one for each pair."""

    def partition(pairs):
        process = subprocess.Popen(
            [binary, "batch", "--jobs", "1", "--quiet", "--fields", fields],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
        )
        mark = pathlib.Path(pids) / str(process.pid)
        mark.touch()
        numbers = []

        def feed():
            try:
                for number, line in pairs:
                    numbers.append(number)
                    process.stdin.write(line.encode() + b"\n")
                process.stdin.close()
            except BrokenPipeError:
                pass  # The process has ended early. The count of results below detects this.

        feeder = threading.Thread(target=feed)
        feeder.start()
        count = 0
        for count, line in enumerate(process.stdout, 1):
            answer = json.loads(line)
            problems = answer.get("problems")
            yield Row(
                number=numbers[count - 1],
                scene=answer.get("scene"),
                verdict=answer.get("verdict"),
                problems=json.dumps(problems) if problems else None,
            )
        feeder.join()
        code = process.wait()
        mark.unlink()
        # Exit codes 0 to 3 depend on the verdicts. With any other exit code, results of this partition are missing.
        if code not in (0, 1, 2, 3) or count != len(numbers):
            raise RuntimeError(f"drystone ended with {code} after {count} of {len(numbers)} lines")

    return partition


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
    arguments.add_argument("--master", default="local[2,4]", help="local[cores,attempts], or a cluster")
    arguments.add_argument("--partitions", type=int, default=32)
    arguments.add_argument("--kill", type=int, default=0, metavar="N")
    arguments.add_argument("--after", type=float, default=5.0, metavar="SECONDS")
    options = arguments.parse_args()
    spark = SparkSession.builder.master(options.master).appName("drystone").getOrCreate()
    spark.sparkContext.setLogLevel("ERROR")
    start = time.perf_counter()
    with tempfile.TemporaryDirectory() as pids:
        ended = threading.Event()
        killer = threading.Thread(target=kill_some, args=(pids, options.kill, options.after, ended), daemon=True)
        killer.start()
        lines = spark.sparkContext.textFile(options.corpus, options.partitions).zipWithIndex()
        pairs = lines.map(lambda pair: (pair[1] + 1, pair[0]))
        binary = options.drystone if os.sep not in options.drystone else os.path.abspath(options.drystone)
        rows = pairs.mapPartitions(analysed(binary, options.fields, pids))
        schema = "number long, scene string, verdict string, problems string"
        spark.createDataFrame(rows, schema).write.mode("overwrite").parquet(options.parquet)
        ended.set()
        killer.join()
    seconds = time.perf_counter() - start

    answers = spark.read.parquet(options.parquet)
    answers.createOrReplaceTempView("answers")
    scenes = lines.count()
    row = spark.sql("select count(*) as n, count(distinct number) as d, max(number) as m from answers").first()
    assert (row.n, row.d, row.m) == (scenes, scenes, scenes), f"{scenes} scenes, but {row}"
    print(f"{scenes} scenes, each answered once, in {seconds:.0f} s: {scenes / seconds:.0f} a second")
    spark.sql("select verdict, count(*) as scenes from answers group by verdict order by scenes desc").show()
    spark.stop()


if __name__ == "__main__":
    main()
