"""Compares the answers and the times of other programs for the same scenes. Lists programs that cannot be loaded.

    python3 -m venv env && env/bin/pip install -r requirements.txt
    cargo build --release && env/bin/python peers.py ../../../target/release/drystone --csv peers.csv
    UPDATE_SNAPSHOTS=1 cargo test --test it peers

The last line draws the README's picture from the table again. --csv keeps the rows that are not measured in this run.

Every program runs once without being timed, and then several times alternately with the others. The table contains
medians.

- Solvers receive the source's program with the contacts already found. Their time is one call of the solver.
- The time of drystone is its whole process: start, reading, finding contacts, analysis, and the result as JSON.
- "drystone batch, one of many" is the time per scene in a batch of many copies. A batch computes verdicts alone.
- Simulators receive polygons and find contacts themselves.

All times are processor time, so that other work on the machine has little effect. After a run longer than --patience,
a program is not run for that kind of structure again.
"""

import argparse
import contextlib
import csv
import importlib.metadata
import io
import json
import math
import os
import pathlib
import resource
import statistics
import subprocess
import sys
import tempfile
import time

import scenes
from programs import program


def spent():
    """Returns the processor time in seconds of this process and of the processes that it started and that ended."""
    children = resource.getrusage(resource.RUSAGE_CHILDREN)
    return time.process_time() + children.ru_utime + children.ru_stime


def drystone(binary):
    def answer(case):
        command = [binary, "check", "--json", case["path"]]
        start = spent()
        result = json.loads(subprocess.run(command, capture_output=True, text=True, check=False).stdout)
        seconds = spent() - start
        frame = result["frames"][0]
        case.setdefault("interfaces", frame["interfaces"])
        return frame["verdict"] == "stable", seconds

    return answer


def drystone_batch(binary):
    """Checks many copies of a scene in one process. Returns the verdict and the time per copy, reading included."""

    def answer(case):
        copies = max(1, 2000 // len(case["scene"]["blocks"]))
        lines = (json.dumps(case["scene"]) + "\n") * copies
        start = spent()
        command = [binary, "batch", "--jobs", "1"]
        output = subprocess.run(command, input=lines, capture_output=True, text=True, check=False).stdout
        seconds = (spent() - start) / copies
        return json.loads(output.split("\n", 1)[0])["verdict"] == "stable", seconds

    return answer


def timed(solve):
    """Times a solver alone: its program is built before the clock starts."""

    def answer(case):
        if "program" not in case:
            case["program"] = program(case["scene"], case["interfaces"])
        start = spent()
        stands = solve(*case["program"])
        return stands, spent() - start

    return answer


def scipy_linprog(method):
    import numpy
    from scipy.optimize import linprog

    def solve(a_eq, need, a_ub):
        cost = numpy.ones(a_eq.shape[1])
        result = linprog(cost, a_ub, numpy.zeros(a_ub.shape[0]), a_eq, need, method=method)
        return {0: True, 2: False}.get(result.status)

    return timed(solve)


def highs(method):
    """HiGHS. Its interior point on normal equations, HiPO, is in a package of its own and ends without crossover."""
    import highspy
    import numpy
    import scipy.sparse

    def solve(a_eq, need, a_ub):
        matrix = scipy.sparse.vstack([a_eq, a_ub]).tocsc()
        model = highspy.HighsLp()
        rows, columns = matrix.shape
        model.num_col_, model.num_row_ = columns, rows
        model.col_cost_ = numpy.ones(columns)
        model.col_lower_ = numpy.zeros(columns)
        model.col_upper_ = numpy.full(columns, highspy.kHighsInf)
        model.row_lower_ = numpy.concatenate([need, numpy.full(a_ub.shape[0], -highspy.kHighsInf)])
        model.row_upper_ = numpy.concatenate([need, numpy.zeros(a_ub.shape[0])])
        model.a_matrix_.format_ = highspy.MatrixFormat.kColwise
        model.a_matrix_.start_, model.a_matrix_.index_ = matrix.indptr, matrix.indices
        model.a_matrix_.value_ = matrix.data
        solver = highspy.Highs()
        solver.silent()
        solver.setOptionValue("solver", method)
        if method == "hipo":
            solver.setOptionValue("run_crossover", "off")
        solver.setOptionValue("threads", 1)
        solver.passModel(model)
        solver.run()
        status = solver.getModelStatus()
        infeasible = (highspy.HighsModelStatus.kInfeasible, highspy.HighsModelStatus.kUnboundedOrInfeasible)
        return True if status == highspy.HighsModelStatus.kOptimal else False if status in infeasible else None

    return timed(solve)


def clarabel_python():
    import clarabel
    import numpy
    import scipy.sparse

    def solve(a_eq, need, a_ub):
        columns = a_eq.shape[1]
        matrix = scipy.sparse.vstack([a_eq, a_ub, -scipy.sparse.identity(columns)]).tocsc()
        bound = numpy.concatenate([need, numpy.zeros(a_ub.shape[0] + columns)])
        cones = [clarabel.ZeroConeT(len(need)), clarabel.NonnegativeConeT(a_ub.shape[0] + columns)]
        settings = clarabel.DefaultSettings()
        settings.verbose = False
        empty = scipy.sparse.csc_matrix((columns, columns))
        solver = clarabel.DefaultSolver(empty, numpy.ones(columns), matrix, bound, cones, settings)
        status = str(solver.solve().status)
        return {"Solved": True, "PrimalInfeasible": False}.get(status)

    return timed(solve)


def gurobi():
    import gurobipy
    import numpy

    environment = gurobipy.Env(empty=True)
    environment.setParam("OutputFlag", 0)
    environment.setParam("Threads", 1)
    environment.start()

    def solve(a_eq, need, a_ub):
        model = gurobipy.Model(env=environment)
        x = model.addMVar(a_eq.shape[1])
        model.setObjective(x.sum())
        model.addConstr(a_eq @ x == need)
        model.addConstr(a_ub @ x <= numpy.zeros(a_ub.shape[0]))
        model.optimize()
        return {2: True, 3: False, 4: False}.get(model.Status)

    return timed(solve)


def gekko_local():
    from gekko import GEKKO

    def solve(a_eq, need, a_ub):
        model = GEKKO(remote=False)
        x = model.Array(model.Var, a_eq.shape[1], lb=0, value=0)
        for matrix, relation in ((a_eq.tocsr(), "equal"), (a_ub.tocsr(), "less")):
            for row in range(matrix.shape[0]):
                entries = range(matrix.indptr[row], matrix.indptr[row + 1])
                total = model.sum([matrix.data[e] * x[matrix.indices[e]] for e in entries])
                model.Equation(total == need[row] if relation == "equal" else total <= 0)
        model.Minimize(model.sum(list(x)))
        model.options.SOLVER = 3
        try:
            model.solve(disp=False)
        except Exception as error:
            if "not found" in str(error).lower():
                return False
            raise
        return model.options.SOLVESTATUS == 1

    return timed(solve)


def bullet():
    import pybullet

    def answer(case):
        start = spent()
        client = pybullet.connect(pybullet.DIRECT)
        try:
            pybullet.setGravity(case["scene"]["gravity"][0], 0, case["scene"]["gravity"][1])
            pybullet.setPhysicsEngineParameter(numSolverIterations=200, fixedTimeStep=1 / 240)
            bodies = []

            def body(polygon, mass):
                centre = [sum(p[i] for p in polygon) / len(polygon) for i in (0, 1)]
                corners = [[x - centre[0], y, z - centre[1]] for x, z in polygon for y in (-0.5, 0.5)]
                shape = pybullet.createCollisionShape(pybullet.GEOM_MESH, vertices=corners)
                made = pybullet.createMultiBody(mass, shape, basePosition=[centre[0], 0, centre[1]])
                pybullet.changeDynamics(made, -1, lateralFriction=0.7**0.5, collisionMargin=0.0)
                return made, centre

            body([[-50, -1], [50, -1], [50, 0], [-50, 0]], 0)
            bodies = [body(block["polygon"], 1.0) for block in case["scene"]["blocks"]]
            for _ in range(480):
                pybullet.stepSimulation()
            moved = 0.0
            for made, centre in bodies:
                (x, _, z), _ = pybullet.getBasePositionAndOrientation(made)
                moved = max(moved, abs(x - centre[0]), abs(z - centre[1]))
        finally:
            pybullet.disconnect(client)
        # The simulation lasts two seconds. A structure that stands moves by less than a twentieth of a block's
        # length.
        return moved < 0.05, spent() - start

    return answer


def compas(solve_by):
    import warnings

    warnings.simplefilter("ignore")
    from compas.datastructures import Mesh
    from compas_assembly.datastructures import Block
    from compas_cra.algorithms import assembly_interfaces_numpy
    from compas_cra.datastructures import CRA_Assembly
    import compas_cra.equilibrium

    def answer(case):
        start = spent()
        # The gravity of compas_cra is vertical, so the structure is rotated instead of gravity.
        gx, gy = case["scene"]["gravity"]
        size = math.hypot(gx, gy)
        down = (gx / size, gy / size)
        assembly = CRA_Assembly()
        every = case["scene"]["ground"] + case["scene"]["blocks"]
        every[0] = {"polygon": [[-60, -1], [60, -1], [60, 0], [-60, 0]]}
        for number, block in enumerate(every):
            flat = [(-x * down[1] + y * down[0], -x * down[0] - y * down[1]) for x, y in block["polygon"]]
            corners = [[x, y, z] for y in (0.0, 1.0) for x, z in flat]
            n = len(flat)
            faces = [list(range(n)), list(range(2 * n - 1, n - 1, -1))]
            faces += [[(k + 1) % n, k, n + k, n + (k + 1) % n] for k in range(n)]
            mesh = Mesh.from_vertices_and_faces(corners, faces)
            assembly.add_block(mesh.copy(cls=Block), node=number)
        assembly.set_boundary_conditions([0])
        assembly_interfaces_numpy(assembly, nmax=min(40, len(every)), amin=1e-3, tmax=1e-4)
        try:
            with contextlib.redirect_stdout(io.StringIO()):
                getattr(compas_cra.equilibrium, solve_by)(assembly, mu=case["scene"]["friction"], density=1.0)
        except (ValueError, RuntimeError):
            return False, spent() - start
        seconds = spent() - start
        # rbe_solve permits tension at a cost. If any tension exceeds the error of the solver, the structure falls.
        forces = [force for interface in assembly.interfaces() for force in interface.forces]
        pushed = sum(force["c_np"] for force in forces)
        return all(force["c_nn"] <= 1e-4 * pushed for force in forces), seconds

    return answer


PEERS = [
    ("scipy linprog, simplex", "scipy", lambda: scipy_linprog("highs-ds")),
    ("scipy linprog, interior point", "scipy", lambda: scipy_linprog("highs-ipm")),
    ("highspy, simplex", "highspy", lambda: highs("simplex")),
    ("highspy, interior point", "highspy", lambda: highs("ipm")),
    ("highspy, HiPO", "highspy-extras", lambda: highs("hipo")),
    ("Clarabel through Python", "clarabel", clarabel_python),
    ("Gurobi within its free size", "gurobipy", gurobi),
    ("GEKKO, solving locally", "gekko", gekko_local),
    ("compas_cra rbe_solve", "compas_cra", lambda: compas("rbe_solve")),
    ("compas_cra cra_solve", "compas_cra", lambda: compas("cra_solve")),
    ("Bullet, 2 s simulated", "pybullet", bullet),
]


def main():
    arguments = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    arguments.add_argument("drystone")
    arguments.add_argument("--sizes", default="10,100,1000")
    arguments.add_argument("--only", help="runs only the programs whose names contain this text")
    arguments.add_argument("--rounds", type=int, default=5)
    arguments.add_argument("--patience", type=float, default=20.0, metavar="SECONDS")
    arguments.add_argument("--csv", type=pathlib.Path, help="also writes the medians to this file, over older ones")
    options = arguments.parse_args()
    binary = os.path.abspath(options.drystone)
    contestants = [
        ("drystone", drystone(binary)),
        ("drystone batch, one of many", drystone_batch(binary)),
    ]
    for name, package, make in PEERS:
        if options.only and options.only not in name:
            continue
        try:
            contestants.append((f"{name} {importlib.metadata.version(package)}", make()))
        except Exception as error:
            print(f"{name}: cannot be loaded: {type(error).__name__}: {error}", file=sys.stderr)
    too_slow = set()
    print("| structure | blocks | stands | program | answer | ms | times drystone |")
    print("|---|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as folder:
        for size in (int(size) for size in options.sizes.split(",")):
            for kind, make in scenes.KINDS.items():
                for stands in (True, False):
                    scene = make(size, stands)
                    path = pathlib.Path(folder) / "scene.json"
                    path.write_text(json.dumps(scene))
                    run(scene, str(path), kind, stands, contestants, options, too_slow)


def run(scene, path, kind, stands, contestants, options, too_slow):
    """Runs all programs on one scene, prints their rows, and writes them to the table of --csv."""
    case = {"scene": scene, "path": path}
    answers, times = {}, {}
    for turn in range(options.rounds + 1):
        for name, ask in contestants:
            if (name, kind) in too_slow:
                continue
            try:
                answer, seconds = ask(case)
            except Exception as error:
                answer, seconds = f"{type(error).__name__}: {str(error).splitlines()[0][:60]}", float("nan")
            answers[name] = answer
            if turn > 0:
                times.setdefault(name, []).append(seconds)
            if seconds > options.patience:
                times[name] = [seconds]
                too_slow.add((name, kind))
    own = statistics.median(times["drystone"])
    table = read(options.csv)
    for name, _ in contestants:
        if name not in times:
            continue
        seconds = statistics.median(times[name])
        answer = answers[name]
        if isinstance(answer, str):
            word, rest = answer, "| |"
        else:
            word = {stands: "right", None: "none"}.get(answer, "WRONG")
            rest = f"{1000 * seconds:.3g} | {seconds / own:.2g} |"
        blocks = len(scene["blocks"])
        if not isinstance(answer, str):
            row = kind, blocks, "yes" if stands else "no", name, word.lower()
            table[row[:4]] = (*row, f"{1000 * seconds:.3g}")
        print(f"| {kind} | {blocks} | {'yes' if stands else 'no'} | {name} | {word} | {rest}", flush=True)
    write(options.csv, table)


HEAD = "structure,blocks,stands,program,answer,milliseconds"


def read(path):
    """Returns the rows of a table. The key of a row is its structure, blocks, whether it stands, and program."""
    if path is None or not path.exists():
        return {}
    with path.open(newline="") as file:
        rows = list(csv.reader(file))[1:]
    return {(kind, int(blocks), stands, name): (kind, int(blocks), stands, name, word, ms) for kind, blocks, stands, name, word, ms in rows}


def write(path, table):
    if path is None:
        return
    with path.open("w", newline="") as file:
        print(HEAD, file=file)
        for kind, blocks, stands, name, word, ms in table.values():
            print(f'{kind},{blocks},{stands},"{name}",{word},{float(ms):g}', file=file)


if __name__ == "__main__":
    main()
