#!/usr/bin/env python3
"""verify.py FILE…: checks certificates of `drystone check --certificate` in exact arithmetic.

Written from the page src/doc/certificate.md, with the standard library alone. Exit code 0 if everything is proved."""
import itertools
import json
import math
import sys
from fractions import Fraction as F

TAN_OF_ANGLE = F(1, 100)  # the largest angle between a contact and the edges that it lies at

vec = lambda p: (F(p[0]), F(p[1]))
sub = lambda p, q: (p[0] - q[0], p[1] - q[1])
dot = lambda p, q: p[0] * q[0] + p[1] * q[1]
cross = lambda p, q: p[0] * q[1] - p[1] * q[0]
turned = lambda g, h: math.degrees(math.atan2(cross(g, h), dot(g, h)))

def wrench(force, at):
    """A force and its moment about the origin."""
    return [force[0], force[1], cross(at, force)]

def add(total, w, factor=1):
    for i in range(3):
        total[i] += factor * w[i]

def edges(body):
    """The edges of outline and holes, each with the body on its left; none for a circle."""
    out = []
    if "circle" in body:
        return out
    for k, ring in enumerate([body["outline"]] + body.get("holes", [])):
        ring = [vec(p) for p in ring]
        pairs = list(zip(ring, ring[1:] + ring[:1]))
        left = (sum(cross(p, q) for p, q in pairs) > 0) == (k == 0)
        out += pairs if left else [(q, p) for p, q in pairs]
    return out

def load(body, index, frame):
    """Weight at the centroid, listed loads times the load factor, and the further load, as one wrench."""
    if body.get("centre") or "circle" in body:
        centre = vec(body.get("centre") or body["circle"]["centre"])
    else:
        parts = [(cross(p, q), p[0] + q[0], p[1] + q[1]) for p, q in edges(body)]
        area = 3 * sum(a for a, _, _ in parts)
        centre = sum(a * x for a, x, _ in parts) / area, sum(a * y for a, _, y in parts) / area
    total = wrench([g * F(body["weight"]) for g in vec(frame["gravity"])], centre)
    factor = F(frame.get("load_factor", 1))
    items = [(item, 1 if item.get("fixed") else factor) for item in body.get("loads", [])]
    further = frame.get("force")
    for item, factor in items + ([(further[1], 1)] if further and further[0] == index else []):
        add(total, wrench(vec(item["force"]), vec(item["at"])), factor)
        total[2] += factor * F(item["torque"])
    return total

def axes(contact):
    """Normal and tangent, not normalised."""
    if len(contact["points"]) == 2:
        t = sub(vec(contact["points"][1]), vec(contact["points"][0]))
        return (t[1], -t[0]), t
    n = vec(contact["normal"])
    return n, (-n[1], n[0])

def grips(frame, values):
    """The robot, the limit and the value of each component of a grip."""
    limits = [(g["robot"], limit) for g in frame.get("grips", []) for limit in g["limits"]]
    return [(*both, value) for both, value in zip(limits, values[3 * len(frame["contacts"]) :])]

def components(frame):
    """For each component: the first body, the second body or None, and the wrench on the first."""
    out = []
    for c in frame["contacts"]:
        (n, t), p = axes(c), [vec(q) for q in c["points"]]
        out += [(c["bodies"][0], c["bodies"][1], w) for w in (wrench(n, p[0]), wrench(n, p[-1]), wrench(t, p[0]))]
    for g in frame.get("grips", []):
        out += [(g["body"], None, w) for w in (wrench((1, 0), vec(g["at"])), wrench((0, 1), vec(g["at"])), (0, 0, 1))]
    return out

def solve(rows):
    """Solves equations, each with its right side at the end; what they leave free is 0. None if they contradict."""
    rows, pivots = [[F(v) for v in row] for row in rows], []
    for j in range(len(rows[0]) - 1 if rows else 0):
        at = len(pivots)
        pivot = next((i for i in range(at, len(rows)) if rows[i][j]), None)
        if pivot is not None:
            rows[at], rows[pivot] = rows[pivot], rows[at]
            rows[at] = own = [v / rows[at][j] for v in rows[at]]
            rows = [r if i == at or not r[j] else [v - r[j] * o for v, o in zip(r, own)] for i, r in enumerate(rows)]
            pivots.append(j)
    found = {j: rows[i][-1] for i, j in enumerate(pivots)}
    return None if any(row[-1] for row in rows[len(pivots) :]) else [found.get(j, 0) for j in range(len((rows or [[0]])[0]) - 1)]

def on_body(part, body):
    """The wrench of a component on a body."""
    return part[2] if part[0] == body else [-v for v in part[2]] if part[1] == body else [0, 0, 0]

def stands(bodies, frame):
    """Yields what is wrong with the forces of a frame."""
    given, parts = frame["forces"], components(frame)
    amounts = [F(v) for three in given["contacts"] + given["grips"] for v in three]
    residual = {k: load(bodies[k], k, frame) for k in frame["placed"]}
    for amount, part in zip(amounts, parts, strict=True):
        for k in set(part[:2]) & set(residual):
            add(residual[k], on_body(part, k), amount)
    done = set()
    for own, by in given["order"]:
        if done & set(own) or any(done & set(parts[k][:2]) or not set(own) & set(parts[k][:2]) for k in by):
            yield f"the order is wrong at {own}"
        done |= set(own)
        changes = solve([[on_body(parts[k], b)[i] for k in by] + [-residual[b][i]] for b in own for i in range(3)])
        for k, change in zip(by, changes or []):
            amounts[k] += change
            for body in set(parts[k][:2]) & set(residual):
                add(residual[body], on_body(parts[k], body), change)
    for k, r in residual.items():
        if any(r):
            yield f"{bodies[k]['id']} does not balance by {float(max(map(abs, r))):.1e} N"
    for k, c in enumerate(frame["contacts"]):
        n1, n2, t = amounts[3 * k : 3 * k + 3]
        slack = min(n1, n2, F(c["friction"]) * (n1 + n2) - abs(t))
        if slack < 0 or (len(c["points"]) == 1 and n2 != 0):
            yield f"contact {k} leaves its law by {float(-slack):.1e}"
    for robot, limit, amount in grips(frame, amounts):
        if limit is not None and abs(amount) > F(limit):
            yield f"{robot} exceeds its limit"

def falls(bodies, frame):
    """Yields what is wrong with the motion of a frame."""
    motion = {}
    for m in frame["motion"]:
        a, v, w = vec(m["at"]), vec(m["velocity"]), F(m["spin"])
        motion[m["body"]] = [v[0] + w * a[1], v[1] - w * a[0], w]  # the velocity of the origin, and the spin
    power = lambda w, body: sum(a * b for a, b in zip(w, motion.get(body, (0, 0, 0))))
    parts = components(frame)
    speed = lambda part: power(part[2], part[0]) - power(part[2], part[1])
    for own, by in frame.get("still", []):
        changes = solve([[v for b in own for v in on_body(parts[k], b)] + [-speed(parts[k])] for k in by])
        for i, change in enumerate(changes or []):
            motion.setdefault(own[i // 3], [F(0)] * 3)[i % 3] += change
    speeds = [speed(part) for part in parts]
    total = sum(power(load(bodies[k], k, frame), k) for k in frame["placed"])
    for k, c in enumerate(frame["contacts"]):
        n1, n2, t = speeds[3 * k : 3 * k + 3]
        if min(n1, n2) < F(c["friction"]) * abs(t):
            yield f"contact {k} can resist by {float(F(c['friction']) * abs(t) - min(n1, n2)):.1e}"
    for robot, limit, speed in grips(frame, speeds):
        total -= F(limit or 0) * abs(speed)
        if limit is None and speed:
            yield f"{robot} holds, but moves by {float(speed):.1e}"
    if total <= 0:
        yield f"the loads do no work: {float(total):.1e}"

def distance2(at, a, b):
    """The square of the distance of a point from a segment."""
    along, start = sub(b, a), sub(at, a)
    length, place = dot(along, along), dot(along, start)
    if 0 < place < length:
        return cross(along, start) ** 2 / length
    return min(dot(start, start), dot(sub(at, b), sub(at, b)))

def places(file, frame, edges_of, farthest):
    """Yields what is wrong with the places and normals of the contacts; and, for a fall, which contacts are missing."""
    bodies, near = file["bodies"], F(file["distance"]) ** 2
    for k, c in enumerate(frame["contacts"]):
        n, p, faces, between = axes(c)[0], vec(c["points"][0]), False, len(c["points"]) == 1
        for body, sign in zip(c["bodies"], (1, -1)):
            if circle := bodies[body].get("circle"):
                r, d, inner = F(circle["radius"]), F(file["distance"]), sub(vec(circle["centre"]), p)
                off, along = dot(inner, inner), sign * dot(n, inner)
                at = max(r - d, 0) ** 2 <= off <= (r + d) ** 2 and len(c["points"]) == 1
                farthest[0] = max(farthest[0], F(abs(math.sqrt(off) - circle["radius"])) ** 2)
                faces = faces or (along > 0 and cross(n, inner) ** 2 <= (TAN_OF_ANGLE * along) ** 2)
            else:
                least = max(min(distance2(vec(q), a, b) for a, b in edges_of[body]) for q in c["points"])
                farthest[0], at = max(farthest[0], least), least <= near
            if not at:
                yield f"contact {k}: a point is not at {bodies[body]['id']}"
            for a, b in edges_of[body]:
                along, across = sign * cross(sub(b, a), n), dot(sub(b, a), n)
                straight = along > 0 and across**2 <= (TAN_OF_ANGLE * along) ** 2
                faces = faces or (straight and distance2(p, a, b) <= near)
            ways = [sub(e[1 - i], e[i]) for e in edges_of[body] for i in (0, 1) if dot(sub(e[i], p), sub(e[i], p)) <= near]
            flat = [sign * dot(n, w) >= 0 or dot(n, w) ** 2 <= (TAN_OF_ANGLE * cross(n, w)) ** 2 for w in ways]
            between = between and len(ways) == 2 and all(flat)
        if not faces and not between:
            yield f"contact {k}: its normal is not that of the outlines"
    if frame["verdict"] == "unstable":
        ground = [k for k, body in enumerate(bodies) if body["ground"]]
        for one, two in itertools.combinations(ground + frame["placed"], 2):
            if two not in ground and touch(file, frame, one, two, edges_of):
                yield f"{bodies[one]['id']} and {bodies[two]['id']} touch without a contact"

def span(body, x):
    """The least and the greatest coordinate of a body."""
    if circle := body.get("circle"):
        return circle["centre"][x] - circle["radius"], circle["centre"][x] + circle["radius"]
    return min(p[x] for p in body["outline"]), max(p[x] for p in body["outline"])

def circles_touch(file, rounds, edges_of, own):
    """Whether a circle comes close to another circle or to an edge where there is no contact."""
    d, shortest = F(file["distance"]), F(file["shortest"])
    if all(rounds):
        apart = sub(vec(rounds[0]["centre"]), vec(rounds[1]["centre"]))
        return not own and dot(apart, apart) <= (F(rounds[0]["radius"]) + F(rounds[1]["radius"]) + d) ** 2
    circle, sides = (rounds[0], edges_of[1]) if rounds[0] else (rounds[1], edges_of[0])
    centre, r = vec(circle["centre"]), F(circle["radius"])
    for a, b in sides:
        along = sub(b, a)
        share = dot(along, sub(centre, a)) / dot(along, along)
        if distance2(centre, a, b) > (r + d) ** 2 or (not 0 <= share <= 1 and not file["corners_carry"]):
            continue
        share = min(max(share, 0), 1)
        foot = a[0] + share * along[0], a[1] + share * along[1]
        if all(dot(sub(foot, vec(s[0])), sub(foot, vec(s[0]))) > (2 * d + shortest) ** 2 + 4 * r * d for s in own):
            return True
    return False

def touch(file, frame, one, two, edges_of):
    """Whether two bodies come close where they have no contact."""
    box = [[span(file["bodies"][k], x) for x in (0, 1)] for k in (one, two)]
    if any(box[i][x][0] - 2 * file["distance"] > box[1 - i][x][1] for i in (0, 1) for x in (0, 1)):
        return False
    near, covered = F(file["distance"]) ** 2, (2 * F(file["distance"]) + F(file["shortest"])) ** 2
    own = [c.get("ends") or c["points"] for c in frame["contacts"] if sorted(c["bodies"]) == sorted((one, two))]
    rounds = [file["bodies"][k].get("circle") for k in (one, two)]
    if any(rounds):
        return circles_touch(file, rounds, [edges_of[one], edges_of[two]], own)
    for (a, b), (c, d) in itertools.product(edges_of[one], edges_of[two]):
        close = [p for p, q, r in ((a, c, d), (b, c, d), (c, a, b), (d, a, b)) if distance2(p, q, r) <= near]
        bare = [p for p in close if all(distance2(p, vec(s[0]), vec(s[-1])) > covered for s in own)]
        turns = [cross(sub(q, p), sub(r, p)) for p, q, r in ((a, b, c), (a, b, d), (c, d, a), (c, d, b))]
        crosses = not own and not close and turns[0] * turns[1] < 0 and turns[2] * turns[3] < 0
        far = any(dot(sub(p, q), sub(p, q)) > covered for p in bare for q in bare)
        if far or crosses or (bare and file["corners_carry"]):
            return True
    return False

def form(file, frame):
    """Yields what makes a frame no structure: bodies that are not there, and numbers of a wrong sign."""
    bodies, placed = file["bodies"], frame["placed"]
    blocks = [k for k, body in enumerate(bodies) if not body["ground"]]
    if file["drystone_certificate"] != 1 or min(file["distance"], file["shortest"]) < 0:
        yield "the version or a distance is wrong"
    if any(body["circle"]["radius"] <= 0 if "circle" in body else sum(cross(p, q) for p, q in edges(body)) == 0 for body in bodies):
        yield "an outline has no area"
    if any(body["weight"] < 0 for body in bodies) or not set(placed) <= set(blocks) or len(set(placed)) != len(placed):
        yield "a weight is negative, or a placed body is no block"
    for k, c in enumerate(frame["contacts"]):
        on, other = c["bodies"]
        fine = on in placed and on != other and (other in placed or bodies[other]["ground"]) and other >= 0
        if not fine or c["friction"] < 0 or (len(c["points"]), "normal" in c) not in ((1, True), (2, False)):
            yield f"contact {k} is none"
    if any(g["body"] not in placed or any(v is not None and v < 0 for v in g["limits"]) for g in frame.get("grips", [])):
        yield "a grip is none"

def changed(frame, change):
    """The frame with one change, made in double arithmetic."""
    frame, ((kind, value),) = json.loads(json.dumps({**frame, "forces": None, "motion": None, "still": []})), change.items()
    if kind in ("load_factor", "gravity"):
        frame[kind] = value
    elif kind == "limit":
        frame["grips"][value[0]]["limits"][value[1]] = value[2]
    elif kind == "force":
        frame["force"] = value[:2]
        if value[2] is not None:
            frame["grips"][value[2]]["limits"] = [0, 0, 0]
    for c in frame["contacts"]:
        ends = c.get("ends") or c["points"]
        if kind == "friction":
            c["friction"] = value
        elif kind == "kernel" and len(ends) == 2:
            step = [(q - p) * (0.5 * value) for p, q in zip(*ends)]
            c["points"] = [[p + d for p, d in zip(ends[0], step)], [p - d for p, d in zip(ends[1], step)]]
            if value >= 1 or c["points"][0] == c["points"][1]:
                c["points"], c["normal"] = c["points"][:1], [ends[1][1] - ends[0][1], ends[0][0] - ends[1][0]]
    return frame

WORDS = {"stable": ("stands", stands, "forces"), "unstable": ("falls", falls, "motion")}

def main(path):
    with open(path, encoding="utf-8") as text:
        file = json.load(text)
    bodies, farthest, edges_of, exact = file["bodies"], [F(0)], [edges(body) for body in file["bodies"]], True
    for entry in file["frames"] + file.get("limits", []):
        frame, faults, name = entry, [], f"frame {entry['frame']}"
        if "change" in entry:
            base = next(frame for frame in file["frames"] if frame["frame"] == entry["frame"])
            frame = {**changed(base, entry["change"]), **entry}
            name += f", just {'inside' if entry['verdict'] == 'stable' else 'beyond'} {entry['of']}"
            angle = turned(base["gravity"], frame["gravity"]) if "gravity" in entry["change"] else None
            name += f" ({json.dumps(entry['change'])}{'' if angle is None else f', gravity turned by {angle:.9f}°'})"
            if not 0 <= entry["change"].get("kernel", 0) <= 1:
                faults = ["a kernel is not between 0 and 1"]
        elif not file["listed"]:
            faults = list(places(file, frame, edges_of, farthest))
        faults += form(file, frame)
        word, check, proof = WORDS.get(frame["verdict"], ("undecided", None, ""))
        faults += check(bodies, frame) if frame.get(proof) is not None and not faults else ["no proof"] * (not faults)
        exact = exact and not faults
        print(f"{name}: {word}, " + ("not proved: " + "; ".join(faults) if faults else "exactly"))
    print("contacts as the scene lists them" if file["listed"] else f"farthest contact point: {float(farthest[0]) ** 0.5:.1e} m")
    return exact

if __name__ == "__main__":
    sys.exit(0 if all([main(path) for path in sys.argv[1:]]) else 1)
