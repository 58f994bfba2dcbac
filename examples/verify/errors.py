"""Errors in the places of joints, centres of gravity and loads, for verify.py: see "A placement tolerance" on the page
src/doc/certificate.md. What must be rounded is rounded to the safe side: up for forces, down for a motion."""
from fractions import Fraction

def root(square, above):
    """A fraction just above or just below a square root."""
    near = Fraction(float(square) ** 0.5) * (1 + Fraction(1 if above else -1, 2**50))
    assert near**2 >= square if above else near**2 <= square
    return near

def size(vector, frame, is_divisor=False):
    """The length of a vector."""
    return root(sum(v * v for v in vector), (frame["verdict"] == "stable") != is_divisor)

def error(index, frame):
    """The largest error of a body. That of the ground is 0."""
    errors = frame.get("errors", {"size": 0})
    return errors["size"] * dict(errors.get("scales", [])).get(index, 1) * (index in frame["placed"])

def inset(contact, frame):
    """The share of its length by which the errors of its bodies move the ends of a contact inward."""
    largest, ends = max(error(k, frame) for k in contact["bodies"]), contact["points"]
    return largest and largest / size([a - b for a, b in zip(*ends)], frame, True) if len(ends) == 2 else largest

def moment(body, index, frame):
    """The largest moment by which the errors of a body change its balance."""
    own, further = body.get("loads", []), frame.get("force") or (None, None)
    factor = abs(frame.get("load_factor", 1))
    sizes = [size(load["force"], frame) * (1 if load.get("fixed") else factor) for load in own]
    sizes += [size(further[1]["force"], frame)] * (further[0] == index) if further[1] else []
    return error(index, frame) * (body["weight"] * size(frame["gravity"], frame) + sum(sizes))

def pattern(body, index, frame):
    """The moment of a body in the pattern of errors."""
    share = dict(frame.get("errors", {}).get("pattern", [])).get(index, 0)
    return share and share * moment(body, index, frame)

def additions(bodies, frame):
    """For each body, the changes of components for its largest error, and the moments that they balance."""
    placed, reactions = frame["placed"] if "errors" in frame else [], frame["forces"].get("reactions", [])
    for body in placed:
        own = [(k, amount * frame["errors"]["size"]) for b, pairs in reactions if b == body for k, amount in pairs]
        yield own, {k: (0, 0, moment(bodies[k], k, frame) if k == body else 0) for k in placed}

def is_valid(frame):
    """Whether the errors leave each joint its length; and, if the frame stands for all, whether none is left out."""
    errors, is_falling = frame.get("errors", {"size": 0}), frame["verdict"] != "stable"
    scales, shares = ([value for _, value in errors.get(key, [])] for key in ("scales", "pattern"))
    lists = [[index for index, _ in errors.get(key, [])] for key in ("scales", "pattern")]
    are_inside = all({*own} <= {*frame["placed"]} and len(own) == len({*own}) for own in lists)
    is_fine = errors["size"] >= 0 and min([0, *scales]) >= 0 and max([0, *map(abs, shares)]) <= 1 and are_inside
    kernel, insets = Fraction(frame.get("kernel", 0)) / 2, [(inset(c, frame), c) for c in frame["contacts"] if is_fine]
    room = [by == 0 or (kernel + by <= Fraction(1, 2) if len(c["points"]) == 2 else is_falling) for by, c in insets]
    return is_fine and all(room) and (is_falling or not shares)
