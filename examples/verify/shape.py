"""The keys and types of a certificate, for verify.py: see the page src/doc/certificate.md. A key that is not on the page,
a key that is there twice, or a value of another type makes the whole certificate invalid."""
import json
import os
import sys
from fractions import Fraction

number = lambda value: type(value) in (int, Fraction)
index = lambda value: type(value) is int and value >= 0
flag = lambda value: type(value) is bool
corners = lambda value: flag(value) or value == "on_edges"
word = lambda value: type(value) is str
pair, three = (number, number), (number, number, number)
or_null = lambda shape: lambda value: value is None or not list(wrong(value, shape, ""))

# A list has one shape for all its items, a tuple one for each. A key with a question mark may be missing.
LOAD = {"force": pair, "at?": pair, "torque": number, "fixed?": flag}
STEPS, SPARSE, LIMITS = [([index], [index])], [(index, number)], (or_null(number),) * 3
REACTIONS = [(index, SPARSE)]
FORCES = or_null({"contacts": [three], "grips": [three], "order": STEPS, "reactions?": REACTIONS})
MOTION = or_null([{"body": index, "at?": pair, "velocity": pair, "spin": number}])
PROOF = {"frame": index, "verdict": word, "forces?": FORCES, "motion?": MOTION, "still?": STEPS}
CHANGED = {"load_factor?": number, "kernel?": number, "force?": (index, LOAD)}
ERRORS = {"size": number, "scales?": SPARSE, "pattern?": SPARSE}
CHANGE = CHANGED | {"gravity?": pair, "friction?": number, "friction_factor?": number}
CHANGE |= {"locked?": lambda value: value in ("turning", "sliding")}
CHANGE |= {"grip_limits?": [LIMITS], "errors?": ERRORS, "loads?": [(index, number, [LOAD])]}
CONTACT = {"bodies": (index, index), "points": [pair], "normal?": pair, "friction": number, "fixed?": flag}
GRIP = {"robot": word, "body": index, "at?": pair, "limits": LIMITS}
CIRCLE = {"centre": pair, "radius": number}
BODY = {"id": word, "ground": flag, "outline": [pair], "weight": number}
BODY |= {"circle?": CIRCLE, "holes?": [[pair]], "centre?": pair, "loads?": [LOAD]}
FRAME = PROOF | CHANGED | {"gravity": pair, "placed": [index], "contacts": [CONTACT], "grips?": [GRIP]}
FILE = {"drystone_certificate": index, "scene_sha256": word, "distance": number, "corners_carry": corners}
FILE |= {"shortest": number, "listed": flag, "bodies": [BODY], "frames": [FRAME]}
FILE |= {"limits?": [PROOF | {"of": word, "change": CHANGE}]}

def wrong(value, shape, place):
    """Yields the places that do not have their shape."""
    if isinstance(shape, dict) and type(value) is dict:
        known = {key.rstrip("?"): own for key, own in shape.items()}
        needed = {key for key in shape if not key.endswith("?")}
        yield from (f"{place}.{key}" for key in value.keys() - known.keys() | needed - value.keys())
        parts = [(value[key], known[key], f"{place}.{key}") for key in value.keys() & known.keys()]
    elif isinstance(shape, (list, tuple)) and type(value) is list and (type(shape) is list or len(value) == len(shape)):
        shapes = shape * len(value) if type(shape) is list else shape
        parts = [(item, own, f"{place}[{k}]") for k, (item, own) in enumerate(zip(value, shapes))]
    else:
        parts = []
        if not callable(shape) or not shape(value):
            yield place
    for part in parts:
        yield from wrong(*part)

def once(pairs):
    """An object of JSON, if no key is there twice."""
    if len(dict(pairs)) < len(pairs):
        raise ValueError("a key is there twice")
    return dict(pairs)

def read(path):
    """A certificate whose keys and types are those of the page. Every number that is no short integer is a double."""
    double = lambda digits: Fraction(float(digits))
    whole = lambda digits: int(digits) if len(digits) < 16 else double(digits)
    with open(path, encoding="utf-8") as text:
        file = json.load(text, parse_float=double, parse_int=whole, parse_constant=Fraction, object_pairs_hook=once)
    places = sorted(wrong(file, FILE, "file"))
    if places:
        raise ValueError(f"{places[0]} is missing, unknown or of another type")
    return file

def mu(contact, frame):
    """The friction coefficient of a contact in a changed frame."""
    factor = 1 if contact.get("fixed") else frame.get("friction_factor", 1)
    return frame.get("friction", contact["friction"]) * factor

def with_loads(file, change):
    """The certificate with the weights and loads of bodies that a change gives them."""
    other = {k: {"weight": weight, "loads": loads} for k, weight, loads in change.get("loads", [])}
    return {**file, "bodies": [{**body, **other.get(k, {})} for k, body in enumerate(file["bodies"])]}

def with_points(frame, bodies):
    """The frame with the points of grips and motions: without a point, the one at which the weight of the body acts."""
    given = lambda items: [{"at": bodies[item["body"]]["centre"], **item} for item in items or []]
    return {**frame, "grips": given(frame.get("grips")), "motion": frame["motion"] and given(frame["motion"])}

def with_locks(frame, bodies):
    """The frame with what cannot turn held by grips that carry any torque, and what cannot slide by smooth contacts."""
    if frame.get("locked") == "turning":
        grips = [{"body": k, "at": bodies[k]["centre"], "limits": [0, 0, None]} for k in frame["placed"]]
        return {**frame, "grips": frame["grips"] + grips}
    if frame.get("locked") != "sliding":
        return frame
    joints, locks = [{**c, "friction": 0} for c in frame["contacts"]], []
    for c in joints:
        (x, y), (far_x, far_y) = c["points"][0], c["points"][-1]
        tx, ty = (-c["normal"][1], c["normal"][0]) if "normal" in c else (far_x - x, far_y - y)
        # The middle is rounded as the coordinates of the file are.
        at = [[Fraction(float(x) + float(far_x - x) / 2), Fraction(float(y) + float(far_y - y) / 2)]]
        locks += [{**c, "points": at, "normal": n} for n in ((tx, ty), (-tx, -ty))]
    return {**frame, "contacts": joints + locks}

def run(check, paths):
    """Whether files are certificates of which everything is proved. A file that is no certificate proves nothing."""
    is_proved = len(paths) > 0
    for path in paths:
        try:
            is_proved &= check(read(path))
            sys.stdout.flush()
        except BrokenPipeError:  # nobody reads what is proved
            os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
            return False
        except (ArithmeticError, AttributeError, LookupError, OSError, RecursionError, TypeError, ValueError) as why:
            print(f"{ascii(path)} proves nothing: {type(why).__name__}: {ascii(str(why))}", flush=True)
            is_proved = False
    return is_proved
