#!/usr/bin/env python3
"""verify.py FILE…: checks certificates of `drystone check --certificate` in exact arithmetic, with Python alone.
Written from the page src/doc/certificate.md. Exit code 0 if everything is proved."""
import json
import sys
from fractions import Fraction
from itertools import chain, combinations, product
from errors import additions, inset, is_valid, pattern
from shape import mu, run, with_loads, with_locks, with_points
from vectors import REST, apart2, cross, dot, left, plus, solve, sub, threes, wrench

TAN_OF_ANGLE = Fraction(1, 100)  # the largest angle between a contact and the edges that it lies at
limits_of = lambda frame: list(chain(*(frame.get("grip_limits") or [g["limits"] for g in frame.get("grips", [])])))

def prepare(body):
    """A body with its edges, centre, and the box around it. A circle is one edge without length, with a radius."""
    circle = body.get("circle", {"centre": [0, 0], "radius": 0})
    rings = [[circle["centre"]]] if "circle" in body else [body["outline"], *body.get("holes", [])]
    rings = [list(zip(ring, ring[1:] + ring[:1])) for ring in rings]
    sizes = [sum(cross(p, q) for p, q in ring) for ring in rings]
    moments = [sum(cross(p, q) * (p[x] + q[x]) for ring in rings for p, q in ring) for x in (0, 1)]
    centre = [Fraction(moment) / sum(sizes) / 3 for moment in moments] if sum(sizes) else circle["centre"]
    r, places = circle["radius"], [[p[x] for p, _ in rings[0]] for x in (0, 1)]
    box, edges = [(min(line) - r, max(line) + r) for line in places], sum(rings, [])
    is_fine = r > 0 or (sum(sizes) > 0 and all((size > 0) == (k == 0) for k, size in enumerate(sizes)))
    return {"centre": centre, **body, "edges": edges, "radius": r, "box": box, "is_fine": is_fine}

def load(body, index, frame):
    """The weight at the centre, the listed loads times the load factor, and the further load, as one wrench."""
    total = wrench([g * body["weight"] for g in frame["gravity"]], body["centre"])
    total[2] += pattern(body, index, frame)
    loads = [(item, 1 if item.get("fixed") else frame.get("load_factor", 1)) for item in body.get("loads", [])]
    loaded, *further = frame.get("force") or [None]
    for item, by in loads + [(item, 1) for item in further if loaded == index]:
        total = plus(plus(total, wrench(item["force"], item.get("at", body["centre"])), by), (0, 0, item["torque"]), by)
    return total

def line(contact, frame):
    """The normal of a contact and the points of its forces. A kernel and errors move these inward from its ends."""
    if "normal" in contact:
        return contact["normal"], contact["points"]
    ends, inward = contact["points"], Fraction(frame.get("kernel", 0)) / 2 + inset(contact, frame)
    return left(sub(*ends)), [plus(p, sub(q, p), inward) for p, q in (ends, ends[::-1])]

def components(frame):
    """Each component of a contact or a grip as the wrenches on its bodies."""
    parts = []
    for c in frame["contacts"]:
        (n, points), (on, other) = line(c, frame), c["bodies"]
        three = wrench(n, points[0]), wrench(n, points[-1]), wrench(left(n), points[0])
        parts += [{on: w, other: [-v for v in w]} for w in three]
    for g in frame.get("grips", []):
        parts += [{g["body"]: w} for w in (wrench((1, 0), g["at"]), wrench((0, 1), g["at"]), (0, 0, 1))]
    return parts

def corrected(frame, parts, given, residual):
    """The conditions of forces after their correction, and the bodies that do not balance."""
    amounts = [0] * len(parts)
    def change(part, amount):
        amounts[part] += amount
        for body in parts[part].keys() & residual.keys():
            residual[body] = plus(residual[body], parts[part][body], amount)
    for part, amount in given:
        change(part, amount)
    # A step changes the residuals of later ones, so each is skipped only when its turn comes.
    for own, by in (step for step in frame["forces"]["order"] if any(any(residual[b]) for b in step[0])):
        rows = [[parts[k].get(b, REST)[i] for k in by] + [-residual[b][i]] for b in own for i in range(3)]
        for k, amount in zip(by, solve(rows, len(by))):
            change(k, amount)
    values = []  # what must not be negative at the contacts, and the components of the grips
    for c, (n1, n2, t) in zip(frame["contacts"], threes(amounts)):
        most = mu(c, frame) * (n1 + n2)
        values += [n1, n2, most - t, most + t, -n2 if "normal" in c else 0]
    return values + amounts[3 * len(frame["contacts"]) :], [k for k, rest in residual.items() if any(rest)]

def stands(bodies, frame):
    """Yields what is wrong with the forces of a frame."""
    forces, parts, ends = frame["forces"], components(frame), 5 * len(frame["contacts"])
    loads = {k: load(bodies[k], k, frame) for k in frame["placed"]}
    values, off = corrected(frame, parts, enumerate(chain(*forces["contacts"], *forces["grips"])), loads)
    spread = [0] * len(values)  # by how much the errors may change the values
    for given, moments in additions(bodies, frame):
        changes, more = corrected(frame, parts, given, moments)
        spread, off = [total + abs(change) for total, change in zip(spread, changes)], off + more
    yield from (f"{bodies[k]['id']} does not balance" for k in off)
    slack = [min(v - by for v, by in zip(values[k : k + 5], spread[k:])) for k in range(0, ends, 5)]
    yield from (f"contact {k} leaves its law by {float(-by):.1e}" for k, by in enumerate(slack) if by < 0)
    grips = zip(limits_of(frame), values[ends:], spread[ends:])
    excess = [abs(value) + by - limit for limit, value, by in grips if limit is not None]
    yield from (f"a robot exceeds its limit by {float(by):.1e}" for by in excess if by > 0)

def falls(bodies, frame):
    """Yields what is wrong with the motion of a frame."""
    motion, parts = {k: REST for k in frame["placed"]}, components(frame)
    for m in frame["motion"]:  # the velocity of the origin, and the spin
        motion[m["body"]] = plus([*m["velocity"], m["spin"]], (m["at"][1], -m["at"][0], 0), m["spin"])
    speed = lambda part: sum(dot(w, motion.get(body, REST)) for body, w in part.items())
    for own, by in frame["still"]:
        rows = [[v for b in own for v in parts[k].get(b, REST)] + [-speed(parts[k])] for k in by]
        for body, change in zip(own, threes(solve(rows, 3 * len(own)))):
            motion[body] = plus(motion[body], change, 1)
    speeds = [speed(part) for part in parts]
    for k, (c, (n1, n2, t)) in enumerate(zip(frame["contacts"], threes(speeds))):
        slack = min(n1, n2) - mu(c, frame) * abs(t)
        if slack < 0:
            yield f"contact {k} can resist by {float(-slack):.1e}"
    grips = list(zip(limits_of(frame), speeds[3 * len(frame["contacts"]) :]))
    yield from (f"a robot holds, but moves by {float(moves):.1e}" for limit, moves in grips if limit is None and moves)
    power = sum(dot(load(bodies[k], k, frame), motion[k]) for k in frame["placed"])
    power -= sum((limit or 0) * abs(moves) for limit, moves in grips)
    if power <= 0:
        yield f"the loads do no work: {float(power):.1e}"

def foot(p, a, b):
    """The point of a segment that is nearest to p."""
    share = Fraction(dot(sub(b, a), sub(p, a))) / (apart2(a, b) or 1)
    return plus(a, sub(b, a), min(max(share, 0), 1))

def places(file, frame, farthest):
    """Yields what is wrong with the places and normals of the contacts. Adds the distances of points to `farthest`."""
    for k, c in enumerate(frame["contacts"]):
        n, p, faces, separates = line(c, frame)[0], c["points"][0], False, len(c["points"]) == 1
        for body, sign in zip([file["bodies"][b] for b in c["bodies"]], (1, -1)):
            r, d, edges = body["radius"], file["distance"], body["edges"]
            away2 = max(min(apart2(q, foot(q, *edge)) for edge in edges) for q in c["points"])
            farthest.append(abs(float(away2) ** 0.5 - float(r)))
            if not max(r - d, 0) ** 2 <= away2 <= (r + d) ** 2 or (r and len(c["points"]) == 2):
                yield f"contact {k}: a point is not at {body['id']}"
            inner = [sub(a, p) if r else left(sub(b, a)) for a, b in edges if apart2(p, foot(p, a, b)) <= (r + d) ** 2]
            faces |= any(0 < sign * dot(n, i) and cross(n, i) ** 2 <= (TAN_OF_ANGLE * dot(n, i)) ** 2 for i in inner)
            ways = [sub(b, a) for edge in edges for a, b in (edge, edge[::-1]) if apart2(a, p) <= d**2]
            flat = [sign * dot(n, w) >= 0 or dot(n, w) ** 2 <= (TAN_OF_ANGLE * cross(n, w)) ** 2 for w in ways]
            separates &= len(ways) == 2 and all(flat)
        if not faces and not separates:
            yield f"contact {k}: its normal is not that of the outlines"

def missing(file, frame):
    """Yields the pairs of bodies that touch without a contact in a frame that falls."""
    bodies, placed, margin = file["bodies"], frame["placed"], 2 * file["distance"]
    ground = [k for k, body in enumerate(bodies) if body["ground"]]
    for k, m in chain(product(ground, placed), combinations(placed, 2)) if frame["verdict"] == "unstable" else ():
        one, two = bodies[k], bodies[m]
        if all(a[0] - margin <= b[1] and b[0] - margin <= a[1] for a, b in zip(one["box"], two["box"])):
            own = [c["points"] for c in frame["contacts"] if {*c["bodies"]} == {k, m}]
            if any(touch(file, one, two, own, edges) for edges in product(one["edges"], two["edges"])):
                yield f"{one['id']} and {two['id']} touch without a contact"

def touch(file, one, two, own, edges):
    """Whether edges of two bodies come close where there is no contact: at a corner, or where a circle is nearest."""
    r, d, carry = one["radius"] + two["radius"], file["distance"], file["corners_carry"]
    sides = [(Fraction(one["radius"]) / (r or 1), *edges), (Fraction(two["radius"]) / (r or 1), *edges[::-1])]
    ends = [(p, foot(p, *other), share) for share, edge, other in sides for p in edge if share or not r]
    points = [plus(p, sub(q, p), share) for p, q, share in ends if apart2(p, q) <= (r + d) ** 2]
    near = (2 * d + file["shortest"]) ** 2 + 4 * r * d
    bare = [p for p in points if all(apart2(p, foot(p, c[0], c[-1])) > near for c in own)]
    tip = lambda p: carry is not True and all(any(apart2(p, q) <= near for q in edge) for edge in edges)
    return any(p not in sum(edges, ()) or apart2(p, q) > near or (carry and not tip(p)) for p in bare for q in bare)

def form(file, frame):
    """Returns what is not valid in a frame: bodies that are not there, and numbers of a wrong sign."""
    bodies, placed, contacts, grips = file["bodies"], frame["placed"], frame["contacts"], frame.get("grips", [])
    blocks = {k for k, body in enumerate(bodies) if not body["ground"]}
    joins = lambda on, other: on in placed and on != other and (other in placed or bodies[other]["ground"])
    moved = [m["body"] for m in frame["motion"] or []] + [body for own, _ in frame["still"] for body in own]
    moved += (frame.get("force") or [])[:1] + [k for k, *_ in frame.get("loads", [])]
    points = [(len({*map(tuple, c["points"])}), len(c["points"]), 2 - ("normal" in c)) for c in contacts]
    numbers = [file["distance"], file["shortest"], *(frame.get(key, 0) for key in ("friction", "friction_factor"))]
    numbers += [b["weight"] for b in bodies] + [c["friction"] for c in contacts] + [n or 0 for n in limits_of(frame)]
    rules = {
        "the version": file["drystone_certificate"] == 1,
        "a body": all(body["is_fine"] for body in bodies),
        "a number": min(numbers) >= 0 and 0 <= frame.get("kernel", 0) <= 1,
        "a placed body": {*moved} <= {*placed} <= blocks and len(placed) == len({*placed}),
        "a contact": all(len({*counts}) == 1 for counts in points) and all(joins(*c["bodies"]) for c in contacts),
        "an error": is_valid(frame),
        "a grip": len(limits_of(frame)) == 3 * len(grips) and all(g["body"] in placed for g in grips),
    }
    return [f"{name} is not valid" for name, is_fine in rules.items() if not is_fine]

def main(file):
    checks = {"stable": ("stands", "inside", stands, "forces"), "unstable": ("falls", "beyond", falls, "motion")}
    frames = {frame["frame"]: frame for frame in file["frames"]}
    farthest, is_exact = [0.0], len(frames) > 0
    if len(frames) < len(file["frames"]):
        raise ValueError("two frames have the same number")
    file["bodies"] = [prepare(body) for body in file["bodies"]]
    for entry in file["frames"] + file.get("limits", []):
        word, side, check, proof = checks.get(entry["verdict"], ("undecided", "at", None, None))
        change, just = entry.get("change", {}), "" if "loads" in entry.get("change", {}) else f"just {side} "
        frame = {**frames[entry["frame"]], "forces": None, "motion": None, "still": [], **change, **entry}
        own, frame = with_loads(file, change), with_points(frame, file["bodies"])
        faults = form(own, frame) or ([] if file["listed"] else [*places(own, frame, farthest), *missing(own, frame)])
        frame = with_locks(frame, file["bodies"])
        faults = faults or (list(check(own["bodies"], frame)) if frame.get(proof) else ["no proof"])
        is_exact &= not faults
        name = f", {just}{entry['of']} ({json.dumps(change, default=float)})" if change else ""
        print(f"frame {entry['frame']}{name}: {word}, {'not proved: ' + '; '.join(faults) if faults else 'exactly'}")
    print("contacts as the scene lists them" if file["listed"] else f"farthest contact point: {max(farthest):.1e} m")
    return is_exact

sys.exit(not run(main, sys.argv[1:]))
