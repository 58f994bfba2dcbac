"""The source's program, [Vallat23] 2.0.7, as matrices: min sum(x)  s.t.  A_eq x = b_eq,  A x <= 0,  x >= 0.

Each interface has six unknowns: at each of its two application points, a normal force and a friction force in either
direction. Bodies and loads come from the scene. The solvers do not find contacts, so these come from the interfaces
that `drystone check --json` lists.
"""

import math

import numpy
import scipy.sparse


def properties(polygon):
    area = x = y = 0.0
    for (x0, y0), (x1, y1) in zip(polygon, polygon[1:] + polygon[:1]):
        cross = x0 * y1 - x1 * y0
        area += cross / 2
        x += (x0 + x1) * cross / 6
        y += (y0 + y1) * cross / 6
    return abs(area), x / area, y / area


def program(scene, interfaces):
    number = {block["id"]: k for k, block in enumerate(scene["blocks"])}
    shapes = [properties(block["polygon"]) for block in scene["blocks"]]
    rows, columns, values = [], [], []
    limits = ([], [], [])
    column = 0
    for k, interface in enumerate(interfaces):
        nx, ny = interface["normal"]
        tangent = (-ny, nx)
        for end, (px, py) in enumerate(interface["application_points"]):
            for fx, fy in ((nx, ny), tangent, (-tangent[0], -tangent[1])):
                for body, sign in zip(interface["bodies"], (1, -1)):
                    if body == "ground":
                        continue
                    b = number[body]
                    _, cx, cy = shapes[b]
                    moment = (px - cx) * fy - (py - cy) * fx
                    for offset, value in enumerate((fx, fy, moment)):
                        if value != 0.0:
                            rows.append(3 * b + offset)
                            columns.append(column)
                            values.append(sign * value)
                column += 1
            row = 2 * k + end
            for offset, value in enumerate((-interface["mu"], 1.0, 1.0)):
                limits[0].append(row)
                limits[1].append(column - 3 + offset)
                limits[2].append(value)
    need = numpy.zeros(3 * len(shapes))
    gx, gy = scene["gravity"]
    heaviest = max(1000 * area for area, _, _ in shapes) * math.hypot(gx, gy)
    for b, (area, _, _) in enumerate(shapes):
        need[3 * b] = -1000 * area * gx / heaviest
        need[3 * b + 1] = -1000 * area * gy / heaviest
    a_eq = scipy.sparse.csc_matrix((values, (rows, columns)), shape=(len(need), column))
    a_ub = scipy.sparse.csc_matrix((limits[2], (limits[0], limits[1])), shape=(2 * len(interfaces), column))
    return a_eq, need, a_ub
