"""Vectors, wrenches and linear equations in exact fractions, for verify.py."""
from fractions import Fraction

REST = (0, 0, 0)
sub = lambda p, q: (p[0] - q[0], p[1] - q[1])
dot = lambda a, b: sum(x * y for x, y in zip(a, b))
cross = lambda a, b: a[0] * b[1] - a[1] * b[0]
left = lambda a: (-a[1], a[0])
apart2 = lambda p, q: dot(sub(p, q), sub(p, q))
plus = lambda total, other, factor: [a + factor * b for a, b in zip(total, other)]
wrench = lambda force, at: [force[0], force[1], cross(at, force)]  # a force and its moment about the origin
threes = lambda values: list(zip(values[::3], values[1::3], values[2::3]))

def solve(rows, unknowns):
    """Solves equations, each with its right side at the end. What they leave free is 0; all, if they contradict."""
    pivots = {}
    for j in range(unknowns):
        pivot = next((row for row in rows if row[j]), None)
        if pivot:
            own = [Fraction(v) / pivot[j] for v in pivot]
            rows = [plus(row, own, -row[j]) for row in rows if row is not pivot]
            pivots = {k: plus(row, own, -row[j]) for k, row in pivots.items()} | {j: own}
    is_solved = not any(row[-1] for row in rows)
    return [pivots[j][-1] if is_solved and j in pivots else 0 for j in range(unknowns)]
