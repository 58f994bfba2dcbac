"""A Gymnasium environment in which two robots build an arch, and a measurement of its speed.

    python examples/gym_arch.py --voussoirs 13 --seconds 5

An action is a number that stands for one of two things: a robot places one of the voussoirs and holds it, or a robot
releases the voussoir that it holds. The reward is 1 for each voussoir after which the structure stands, 10 for the
finished arch that stands without robots, and -1 for a fall or for an action that is not possible. A fall or the
finished arch ends the episode.

With `solver="highs"`, a linear program that scipy solves decides each step instead of drystone. With
`solver="compas_cra"`, the function `rbe_solve` of the package compas_cra decides each step. The script measures all
solvers that are installed.
"""

from __future__ import annotations

import argparse
import contextlib
import importlib.util
import io
import math
import random
import time

import drystone as ds

try:
    import gymnasium
    from gymnasium.spaces import Discrete, MultiBinary

    Base = gymnasium.Env
except ImportError:
    Base = object

FRICTION = 0.7
FORCE = 400.0
"""The largest force of each robot in each direction, N."""
TORQUE = 200.0
"""The largest torque of each robot, N·m."""


def voussoirs(count: int, span: float = 4.0, thickness: float = 0.6) -> list[list[tuple[float, float]]]:
    """Returns the outlines of the voussoirs of a semicircular arch, from left to right, in metres."""
    inner, outer = span / 2, span / 2 + thickness

    def at(radius: float, number: int) -> tuple[float, float]:
        angle = math.pi * (1 - number / count)
        # Set the height to exactly 0, so that the first and the last joint lie on the ground without rounding.
        height = 0.0 if number in (0, count) else radius * math.sin(angle)
        return (radius * math.cos(angle), height)

    return [[at(inner, n), at(outer, n), at(outer, n + 1), at(inner, n + 1)] for n in range(count)]


class DrystoneSolver:
    """Decides with a session of drystone whether the structure stands after each step."""

    def __init__(self, outlines: list[list[tuple[float, float]]]) -> None:
        self.outlines = outlines
        scene = ds.Scene(friction=FRICTION, density=100, contact_tolerance=1e-6)
        scene.ground([(-9, -1), (9, -1), (9, 0), (-9, 0)])
        for robot in ("left", "right"):
            scene.robot(robot, limits={"force": FORCE, "torque": TORQUE})
        self.start = ds.Session(scene, verdict_only=True)
        self.reset()

    def reset(self) -> None:
        self.session = self.start.copy()

    def place(self, robot: str, number: int) -> bool:
        self.session.place(str(number), self.outlines[number])
        return self.session.hold(robot, str(number)) == "stable"

    def release(self, robot: str) -> bool:
        return self.session.release(robot) == "stable"


class StepSolver:
    """The base class of solvers that decide each step anew with `stands`.

    The class keeps the numbers of the placed voussoirs and of those that robots hold.
    """

    def reset(self) -> None:
        self.placed: set[int] = set()
        self.held: dict[str, int] = {}

    def place(self, robot: str, number: int) -> bool:
        self.placed.add(number)
        self.held[robot] = number
        return self.stands()

    def release(self, robot: str) -> bool:
        del self.held[robot]
        return self.stands()

    def stands(self) -> bool:
        raise NotImplementedError


class HighsSolver(StepSolver):
    """Decides each step with a linear program for HiGHS.

    The joints are computed from the order of the voussoirs, whereas drystone finds the joints itself.
    """

    def __init__(self, outlines: list[list[tuple[float, float]]]) -> None:
        import numpy
        from scipy.optimize import linprog

        self.numpy, self.linprog = numpy, linprog
        self.outlines = outlines
        self.centres, self.weights = [], []
        for outline in outlines:
            pairs = list(zip(outline, outline[1:] + outline[:1]))
            cross = [a[0] * b[1] - b[0] * a[1] for a, b in pairs]
            area = sum(cross) / 2
            centre = [sum((a[k] + b[k]) * c for (a, b), c in zip(pairs, cross)) / (6 * area) for k in (0, 1)]
            self.centres.append(centre)
            self.weights.append(abs(area) * 100 * 9.81)
        self.reset()

    def stands(self) -> bool:
        numpy = self.numpy
        rows = {number: 3 * row for row, number in enumerate(sorted(self.placed))}
        columns, limits = [], []

        def column(parts: list[tuple[int, tuple[float, float], tuple[float, float]]], limit: tuple[float | None, float | None]) -> None:
            one = numpy.zeros(3 * len(rows))
            for number, force, at in parts:
                if number in rows:
                    x, y = at[0] - self.centres[number][0], at[1] - self.centres[number][1]
                    one[rows[number] : rows[number] + 3] += (*force, x * force[1] - y * force[0])
            columns.append(one)
            limits.append(limit)

        for joint in range(len(self.outlines) + 1):
            before, after = joint - 1, joint
            ends = self.outlines[after][:2] if after < len(self.outlines) else self.outlines[before][2:]
            inner_side = [number for number in (before, after) if 0 <= number < len(self.outlines)]
            if not all(number in rows for number in inner_side):
                continue
            (ax, ay), (bx, by) = ends
            length = math.hypot(bx - ax, by - ay)
            along = ((bx - ax) / length, (by - ay) / length)
            normal = (-along[1], along[0])
            inside = after if after < len(self.outlines) else before
            centre = self.centres[inside]
            if (centre[0] - ax) * normal[0] + (centre[1] - ay) * normal[1] < 0:
                normal = (-normal[0], -normal[1])
            other = before if inside == after else after
            for at in ends:
                for side in (-1, 1):
                    force = tuple(normal[k] + side * FRICTION * along[k] for k in (0, 1))
                    against = (-force[0], -force[1])
                    column([(inside, force, at), (other, against, at)], (0, None))
        for number in self.held.values():
            at = self.centres[number]
            column([(number, (1, 0), at)], (-FORCE, FORCE))
            column([(number, (0, 1), at)], (-FORCE, FORCE))
            couple = numpy.zeros(3 * len(rows))
            couple[rows[number] + 2] = 1
            columns.append(couple)
            limits.append((-TORQUE, TORQUE))
        if not columns:
            return not rows
        load = numpy.zeros(3 * len(rows))
        for number, row in rows.items():
            load[row + 1] = self.weights[number]
        solved = self.linprog(
            numpy.zeros(len(columns)), A_eq=numpy.array(columns).T, b_eq=load, bounds=limits, method="highs"
        )
        return solved.status == 0


class CraSolver(StepSolver):
    """Decides each step with `rbe_solve` of compas_cra.

    The joints of the whole arch are found once, in the constructor. compas_cra has no robots, so a held block is
    a support, without a limit on the force of the support.
    """

    def __init__(self, outlines: list[list[tuple[float, float]]]) -> None:
        import compas_cra.equilibrium
        from compas.datastructures import Mesh
        from compas_assembly.datastructures import Block
        from compas_cra.algorithms import assembly_interfaces_numpy
        from compas_cra.datastructures import CRA_Assembly

        self.rbe_solve, self.Assembly = compas_cra.equilibrium.rbe_solve, CRA_Assembly
        self.blocks = []
        whole = CRA_Assembly()
        floor = [(-9, 0), (9, 0), (9, -1), (-9, -1)]
        # The outlines are clockwise. Reverse them, because the normals of the faces have to point outwards.
        for number, outline in enumerate([one[::-1] for one in (*outlines, floor)]):
            corners = [(x, y, z) for y in (0.0, 1.0) for x, z in outline]
            sides = [[(k + 1) % 4, k, 4 + k, 4 + (k + 1) % 4] for k in range(4)]
            mesh = Mesh.from_vertices_and_faces(corners, [[0, 1, 2, 3], [7, 6, 5, 4], *sides])
            self.blocks.append(mesh.copy(cls=Block))
            whole.add_block(self.blocks[-1], node=number)
        self.ground = len(outlines)
        assembly_interfaces_numpy(whole, nmax=len(self.blocks), amin=1e-3)
        self.joints = {edge: whole.graph.edge_attribute(edge, "interfaces") for edge in whole.graph.edges()}
        assert len(self.joints) == len(outlines) + 1
        self.reset()

    def stands(self) -> bool:
        present, fixed = self.placed | {self.ground}, {*self.held.values(), self.ground}
        joints = {(u, v): found for (u, v), found in self.joints.items() if {u, v} <= present and not {u, v} <= fixed}
        touching = {number for edge in joints for number in edge}
        if not self.placed - fixed <= touching:
            return False
        if not joints:
            return True
        assembly = self.Assembly()
        for number in sorted(present):
            assembly.add_block(self.blocks[number], node=number)
        assembly.set_boundary_conditions(sorted(fixed))
        for (u, v), found in joints.items():
            for interface in found:
                assembly.add_interface_to_interfaces(u, v, interface)
        try:
            with contextlib.redirect_stdout(io.StringIO()):
                self.rbe_solve(assembly, mu=FRICTION, density=1.0)
        except ValueError:
            return False
        # rbe_solve allows tension and minimises it. If a joint needs more tension than the error of the solver, the
        # structure falls.
        forces = [force for interface in assembly.interfaces() for force in interface.forces]
        pushed = sum(force["c_np"] for force in forces)
        return all(force["c_nn"] <= 1e-4 * pushed for force in forces)


SOLVERS = {"drystone": DrystoneSolver, "highs": HighsSolver, "compas_cra": CraSolver}
NEEDS = {"drystone": "drystone", "highs": "scipy", "compas_cra": "compas_cra"}
"""For each solver, the package that the solver needs."""


class ArchEnv(Base):
    """The Gymnasium environment for an arch of `count` voussoirs. `solver` is a key of `SOLVERS`."""

    metadata = {"render_modes": ["svg"]}

    def __init__(self, count: int = 13, solver: str = "drystone") -> None:
        self.count = count
        outlines = voussoirs(count)
        self.solver = SOLVERS[solver](outlines)
        self.robots = ("left", "right")
        if Base is not object:
            self.action_space = Discrete(2 * count + 2)
            self.observation_space = MultiBinary(3 * count)
        self.render_mode = "svg"

    def reset(self, *, seed=None, options=None):
        if Base is not object:
            super().reset(seed=seed)
        self.solver.reset()
        self.placed: set[int] = set()
        self.held: dict[str, int] = {}
        return self._observation(), {}

    def actions(self) -> list[int]:
        """Returns the possible actions.

        A robot that holds nothing can place a voussoir next to a placed voussoir or on the ground.
        """
        free = [n for n in range(self.count) if n not in self.placed and self._reachable(n)]
        actions = [r * self.count + n for r in (0, 1) if self.robots[r] not in self.held for n in free]
        return actions + [2 * self.count + r for r in (0, 1) if self.robots[r] in self.held]

    def step(self, action):
        if action not in self.actions():
            return self._observation(), -1.0, False, False, {}
        if action >= 2 * self.count:
            robot = self.robots[action - 2 * self.count]
            del self.held[robot]
            stands, reward = self.solver.release(robot), 0.0
        else:
            robot, number = self.robots[action // self.count], int(action % self.count)
            self.placed.add(number)
            self.held[robot] = number
            stands, reward = self.solver.place(robot, number), 1.0
        if not stands:
            return self._observation(), -1.0, True, False, {}
        if len(self.placed) == self.count and not self.held:
            return self._observation(), 10.0, True, False, {}
        return self._observation(), reward, False, False, {}

    def render(self):
        return self.solver.session._repr_svg_()

    def _reachable(self, number: int) -> bool:
        return number in (0, self.count - 1) or bool({number - 1, number + 1} & self.placed)

    def _observation(self):
        held = [self.held.get(robot) for robot in self.robots]
        values = [int(n in self.placed) for n in range(self.count)]
        values += [int(n == one) for one in held for n in range(self.count)]
        if Base is object:
            return values
        import numpy

        return numpy.array(values, dtype=numpy.int8)


def played(env: ArchEnv, seconds: float, seed: int) -> tuple[int, float, list[float]]:
    """Plays random episodes for `seconds` of wall time.

    Returns the number of steps, the processor time of these steps in seconds, and the reward of each step.
    """
    chance = random.Random(seed)
    steps, rewards = 0, []
    env.reset()
    start, spent = time.perf_counter(), time.process_time()
    while time.perf_counter() - start < seconds:
        _, reward, done, _, _ = env.step(chance.choice(env.actions()))
        rewards.append(reward)
        steps += 1
        if done:
            env.reset()
    return steps, time.process_time() - spent, rewards


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--voussoirs", type=int, default=13)
    parser.add_argument("--seconds", type=float, default=10.0, help="for each solver")
    arguments = parser.parse_args()
    solvers = [solver for solver, package in NEEDS.items() if importlib.util.find_spec(package) is not None]
    environments = {solver: ArchEnv(arguments.voussoirs, solver) for solver in solvers}
    steps, same, both = (dict.fromkeys(solvers, 0) for _ in range(3))
    spent = dict.fromkeys(solvers, 0.0)
    # The solvers take turns, so that other work on the machine slows all solvers about equally.
    for turn in range(10):
        rewards = {}
        for solver, environment in environments.items():
            count, seconds, rewards[solver] = played(environment, arguments.seconds / 10, seed=turn)
            steps[solver] += count
            spent[solver] += seconds
        for solver in solvers:
            pairs = list(zip(rewards[solver], rewards["drystone"]))
            both[solver] += len(pairs)
            same[solver] += sum(one == other for one, other in pairs)
    print("| solver | steps per second of processor time | drystone is faster by | rewards that agree |")
    print("|---|---|---|---|")
    rate = steps["drystone"] / spent["drystone"]
    for solver in solvers:
        other = steps[solver] / spent[solver]
        print(f"| {solver} | {other:.0f} | {rate / other:.1f} | {same[solver]} of {both[solver]} |")


if __name__ == "__main__":
    main()
