//! Reads the objects of a scene file from the syntax tree into the types of [`format`](super::super::format).
//!
//! A test in `format::schema` compares the lists of keys with the fields of the types.

use super::super::format::{
    BlockEntry, CellEntry, CellHalf, ContactEntry, Expectation, ForceUnit, FrictionPairEntry, GridEntry, GridKind,
    GripEntry, GroundEntry, HoldEntry, LengthUnit, LimitsEntry, LoadEntry, Map, MaterialEntry, Pair, RobotEntry,
    SceneFile, ShapeEntry, StepEntry, UnitsEntry, Version,
};
use crate::read::{Expected, Fields, Node, NodeKind, Reader, Trail};

/// For every type of the format: its name, and its keys in alphabetical order.
#[cfg(test)]
pub(in crate::mechanics::scene) const KEYS: &[(&str, &[&str])] = &[
    ("SceneFile", SCENE),
    ("MaterialEntry", MATERIAL),
    ("FrictionPairEntry", FRICTION_PAIR),
    ("GridEntry", GRID),
    ("ShapeEntry", SHAPE),
    ("GroundEntry", GROUND),
    ("BlockEntry", BLOCK),
    ("RobotEntry", ROBOT),
    ("LimitsEntry", LIMITS),
    ("LoadEntry", LOAD),
    ("StepEntry", STEP),
    ("GripEntry", GRIP),
    ("UnitsEntry", UNITS),
    ("ContactEntry", CONTACT),
];

const SCENE: &[&str] = &[
    "$schema",
    "author",
    "blocks",
    "contact_tolerance",
    "contacts",
    "corner_contacts",
    "date",
    "density",
    "drystone",
    "expect",
    "friction",
    "friction_pairs",
    "gravity",
    "grid",
    "ground",
    "kernel",
    "loads",
    "materials",
    "project",
    "robots",
    "shapes",
    "silence",
    "steps",
    "thickness",
    "title",
    "units",
];
const MATERIAL: &[&str] = &["density", "fill", "friction"];
const FRICTION_PAIR: &[&str] = &["between", "friction"];
const GRID: &[&str] = &["kind", "side"];
const SHAPE: &[&str] = &["cells", "holes", "polygon"];
const GROUND: &[&str] = &["angle", "at", "cells", "fill", "friction", "holes", "material", "polygon", "shape"];
const BLOCK: &[&str] = &[
    "angle", "at", "cells", "centre", "density", "fill", "friction", "holes", "id", "mass", "material", "polygon",
    "shape", "weight",
];
const ROBOT: &[&str] = &["at", "holds", "id", "limits"];
const LIMITS: &[&str] = &["force", "fx", "fy", "torque"];
const LOAD: &[&str] = &["at", "block", "force", "torque"];
const STEP: &[&str] = &["expect", "hold", "place", "plan", "release", "remove", "title"];
const GRIP: &[&str] = &["at", "block"];
const CONTACT: &[&str] = &["at", "bodies", "friction", "normal"];
const UNITS: &[&str] = &["force", "length"];

const CELL: &str = "[x, y, \"up\"], [x, y, \"down\"] or [x, y]";

type R<'s> = Reader<'s>;

/// Reads the whole scene file. A value that does not fit the format is reported and left out.
pub(super) fn scene<'s>(r: &mut R<'s>, node: &'s Node<'s>) -> SceneFile {
    let at = &Trail::Top;
    let Some(o) = r.object(node, at, SCENE) else {
        return SceneFile::default();
    };
    SceneFile {
        schema: r.optional(o, at, "$schema", |r, n, at| r.text(n, at)),
        drystone: r.required(o, at, "drystone", version).unwrap_or_default(),
        title: r.optional(o, at, "title", |r, n, at| r.text(n, at)),
        author: text(r, o, at, "author"),
        project: text(r, o, at, "project"),
        date: text(r, o, at, "date"),
        units: r.optional(o, at, "units", units),
        gravity: r.optional(o, at, "gravity", |r, n, at| r.vector(n, at)),
        friction: number(r, o, at, "friction"),
        kernel: number(r, o, at, "kernel"),
        density: number(r, o, at, "density"),
        thickness: number(r, o, at, "thickness"),
        materials: map(r, o, at, "materials", material),
        friction_pairs: r.list(o, at, "friction_pairs", friction_pair),
        grid: r.optional(o, at, "grid", grid),
        shapes: map(r, o, at, "shapes", shape),
        ground: r.list(o, at, "ground", ground),
        blocks: (r.required(o, at, "blocks", |r, n, at| r.entries(n, at, block))).unwrap_or_default(),
        contacts: r.list(o, at, "contacts", contact),
        robots: r.list(o, at, "robots", robot),
        loads: r.list(o, at, "loads", load),
        contact_tolerance: number(r, o, at, "contact_tolerance"),
        corner_contacts: r.optional(o, at, "corner_contacts", |r, n, at| r.flag(n, at)),
        steps: r.list(o, at, "steps", step),
        expect: expectation(r, o, at),
        silence: names(r, o, at, "silence"),
    }
}

fn map<'s, T: Default>(
    r: &mut R<'s>,
    o: Fields<'s>,
    at: &Trail<'_>,
    key: &str,
    read: impl FnMut(&mut R<'s>, &'s Node<'s>, &Trail<'_>) -> Option<T>,
) -> Map<T> {
    let named = o.get(key).and_then(|node| r.names(node, &at.key(key), read));
    Map(named.unwrap_or_default())
}

fn number<'s>(r: &mut R<'s>, o: Fields<'s>, at: &Trail<'_>, key: &str) -> Option<f64> {
    r.optional(o, at, key, |r, n, at| r.number(n, at))
}

fn text<'s>(r: &mut R<'s>, o: Fields<'s>, at: &Trail<'_>, key: &str) -> Option<String> {
    r.optional(o, at, key, |r, n, at| r.text(n, at))
}

fn point<'s>(r: &mut R<'s>, o: Fields<'s>, at: &Trail<'_>, key: &str) -> Option<Pair> {
    r.optional(o, at, key, |r, n, at| r.point(n, at))
}

fn names<'s>(r: &mut R<'s>, o: Fields<'s>, at: &Trail<'_>, key: &str) -> Vec<String> {
    r.list(o, at, key, |r, n, at| r.text(n, at))
}

fn corners<'s>(r: &mut R<'s>, node: &'s Node<'s>, at: &Trail<'_>) -> Option<Vec<Pair>> {
    r.entries(node, at, |r, n, at| r.point(n, at))
}

fn polygon<'s>(r: &mut R<'s>, o: Fields<'s>, at: &Trail<'_>) -> Option<Vec<Pair>> {
    r.optional(o, at, "polygon", corners)
}

fn holes<'s>(r: &mut R<'s>, o: Fields<'s>, at: &Trail<'_>) -> Vec<Vec<Pair>> {
    r.list(o, at, "holes", corners)
}

fn cells<'s>(r: &mut R<'s>, o: Fields<'s>, at: &Trail<'_>) -> Option<Vec<CellEntry>> {
    let list = r.optional(o, at, "cells", |r, n, at| {
        // If a cell cannot be read, its body counts as unreadable. Any value can therefore take the place of this cell.
        r.entries(n, at, |r, n, at| cell(r, n, at).map(Some))
    })?;
    let read = |cell: Option<CellEntry>| cell.unwrap_or(CellEntry::Square(0.0, 0.0));
    Some(list.into_iter().map(read).collect())
}

fn version<'s>(r: &mut R<'s>, node: &'s Node<'s>, at: &Trail<'_>) -> Option<Version> {
    if let (NodeKind::Number(_), Ok(number)) = (&node.kind, r.written(node).parse()) {
        return Some(Version(number));
    }
    r.wrong(node, at, Expected::Whole);
    None
}

fn contact<'s>(r: &mut R<'s>, node: &'s Node<'s>, at: &Trail<'_>) -> Option<ContactEntry> {
    let o = r.object(node, at, CONTACT)?;
    let bodies = r.required(o, at, "bodies", |r, n, at| match &n.kind {
        NodeKind::List(list) if list.len() == 2 => r.entries(n, at, |r, n, at| r.text(n, at)),
        _ => {
            r.wrong(n, at, Expected::Other("a list with the names of two bodies"));
            None
        }
    });
    Some(ContactEntry {
        bodies: bodies.and_then(|b| b.try_into().ok()).unwrap_or_default(),
        at: (r.required(o, at, "at", |r, n, at| r.point(n, at))).unwrap_or_default(),
        normal: (r.required(o, at, "normal", |r, n, at| r.number(n, at))).unwrap_or_default(),
        friction: number(r, o, at, "friction"),
    })
}

fn units<'s>(r: &mut R<'s>, node: &'s Node<'s>, at: &Trail<'_>) -> Option<UnitsEntry> {
    let o = r.object(node, at, UNITS)?;
    let lengths = [
        ("m", LengthUnit::Metre),
        ("cm", LengthUnit::Centimetre),
        ("mm", LengthUnit::Millimetre),
        ("in", LengthUnit::Inch),
        ("ft", LengthUnit::Foot),
    ];
    let forces = [
        ("N", ForceUnit::Newton),
        ("kN", ForceUnit::Kilonewton),
        ("MN", ForceUnit::Meganewton),
        ("lbf", ForceUnit::PoundForce),
    ];
    Some(UnitsEntry {
        length: r.optional(o, at, "length", |r, n, at| r.choice(n, at, &lengths)),
        force: r.optional(o, at, "force", |r, n, at| r.choice(n, at, &forces)),
    })
}

fn material<'s>(r: &mut R<'s>, node: &'s Node<'s>, at: &Trail<'_>) -> Option<MaterialEntry> {
    let o = r.object(node, at, MATERIAL)?;
    Some(MaterialEntry {
        density: number(r, o, at, "density"),
        friction: number(r, o, at, "friction"),
        fill: text(r, o, at, "fill"),
    })
}

fn friction_pair<'s>(r: &mut R<'s>, node: &'s Node<'s>, at: &Trail<'_>) -> Option<FrictionPairEntry> {
    let o = r.object(node, at, FRICTION_PAIR)?;
    let between = r.required(o, at, "between", |r, n, at| match &n.kind {
        NodeKind::List(list) if list.len() == 2 => r.entries(n, at, |r, n, at| r.text(n, at)),
        _ => {
            r.wrong(n, at, Expected::Other("a list with the names of two materials"));
            None
        }
    });
    Some(FrictionPairEntry {
        between: between.and_then(|b| b.try_into().ok()).unwrap_or_default(),
        friction: (r.required(o, at, "friction", |r, n, at| r.number(n, at))).unwrap_or_default(),
    })
}

fn grid<'s>(r: &mut R<'s>, node: &'s Node<'s>, at: &Trail<'_>) -> Option<GridEntry> {
    let o = r.object(node, at, GRID)?;
    let kinds = [("triangular", GridKind::Triangular), ("square", GridKind::Square)];
    Some(GridEntry {
        kind: (r.required(o, at, "kind", |r, n, at| r.choice(n, at, &kinds))).unwrap_or_default(),
        side: number(r, o, at, "side"),
    })
}

fn cell<'s>(r: &mut R<'s>, node: &'s Node<'s>, at: &Trail<'_>) -> Option<CellEntry> {
    let items = match &node.kind {
        NodeKind::List(list) if (2..=3).contains(&list.len()) => r.items(list),
        _ => {
            r.wrong(node, at, Expected::Other(CELL));
            return None;
        }
    };
    let halves = [("up", CellHalf::Up), ("down", CellHalf::Down)];
    let x = r.number(&items[0], &at.index(0));
    let y = r.number(&items[1], &at.index(1));
    match items.get(2) {
        None => Some(CellEntry::Square(x?, y?)),
        Some(half) => {
            let half = r.choice(half, &at.index(2), &halves);
            Some(CellEntry::Triangle(x?, y?, half?))
        }
    }
}

fn shape<'s>(r: &mut R<'s>, node: &'s Node<'s>, at: &Trail<'_>) -> Option<ShapeEntry> {
    let o = r.object(node, at, SHAPE)?;
    Some(ShapeEntry { polygon: polygon(r, o, at), holes: holes(r, o, at), cells: cells(r, o, at) })
}

fn ground<'s>(r: &mut R<'s>, node: &'s Node<'s>, at: &Trail<'_>) -> Option<GroundEntry> {
    let o = r.object(node, at, GROUND)?;
    Some(GroundEntry {
        polygon: polygon(r, o, at),
        holes: holes(r, o, at),
        cells: cells(r, o, at),
        shape: text(r, o, at, "shape"),
        at: point(r, o, at, "at"),
        angle: number(r, o, at, "angle"),
        material: text(r, o, at, "material"),
        friction: number(r, o, at, "friction"),
        fill: text(r, o, at, "fill"),
    })
}

fn block<'s>(r: &mut R<'s>, node: &'s Node<'s>, at: &Trail<'_>) -> Option<BlockEntry> {
    let o = r.object(node, at, BLOCK)?;
    Some(BlockEntry {
        id: text(r, o, at, "id"),
        polygon: polygon(r, o, at),
        holes: holes(r, o, at),
        cells: cells(r, o, at),
        shape: text(r, o, at, "shape"),
        at: point(r, o, at, "at"),
        angle: number(r, o, at, "angle"),
        material: text(r, o, at, "material"),
        centre: point(r, o, at, "centre"),
        weight: number(r, o, at, "weight"),
        mass: number(r, o, at, "mass"),
        density: number(r, o, at, "density"),
        friction: number(r, o, at, "friction"),
        fill: text(r, o, at, "fill"),
    })
}

fn robot<'s>(r: &mut R<'s>, node: &'s Node<'s>, at: &Trail<'_>) -> Option<RobotEntry> {
    let o = r.object(node, at, ROBOT)?;
    Some(RobotEntry {
        id: text(r, o, at, "id"),
        holds: text(r, o, at, "holds"),
        at: point(r, o, at, "at"),
        limits: r.optional(o, at, "limits", limits),
    })
}

fn limits<'s>(r: &mut R<'s>, node: &'s Node<'s>, at: &Trail<'_>) -> Option<LimitsEntry> {
    let o = r.object(node, at, LIMITS)?;
    Some(LimitsEntry {
        fx: number(r, o, at, "fx"),
        fy: number(r, o, at, "fy"),
        torque: number(r, o, at, "torque"),
        force: number(r, o, at, "force"),
    })
}

fn load<'s>(r: &mut R<'s>, node: &'s Node<'s>, at: &Trail<'_>) -> Option<LoadEntry> {
    let o = r.object(node, at, LOAD)?;
    Some(LoadEntry {
        block: (r.required(o, at, "block", |r, n, at| r.text(n, at))).unwrap_or_default(),
        force: r.optional(o, at, "force", |r, n, at| r.vector(n, at)),
        at: point(r, o, at, "at"),
        torque: number(r, o, at, "torque"),
    })
}

fn step<'s>(r: &mut R<'s>, node: &'s Node<'s>, at: &Trail<'_>) -> Option<StepEntry> {
    let o = r.object(node, at, STEP)?;
    Some(StepEntry {
        title: text(r, o, at, "title"),
        release: names(r, o, at, "release"),
        remove: names(r, o, at, "remove"),
        place: names(r, o, at, "place"),
        hold: map(r, o, at, "hold", hold),
        plan: map(r, o, at, "plan", |r, n, at| r.text(n, at)),
        expect: expectation(r, o, at),
    })
}

fn expectation<'s>(r: &mut R<'s>, o: Fields<'s>, at: &Trail<'_>) -> Option<Expectation> {
    let choices = [("stable", Expectation::Stable), ("unstable", Expectation::Unstable)];
    r.optional(o, at, "expect", |r, n, at| r.choice(n, at, &choices))
}

fn hold<'s>(r: &mut R<'s>, node: &'s Node<'s>, at: &Trail<'_>) -> Option<HoldEntry> {
    match &node.kind {
        NodeKind::Text(block) => Some(HoldEntry::Block(block.clone().into_owned())),
        NodeKind::Object(_) => {
            let o = r.object(node, at, GRIP)?;
            Some(HoldEntry::Grip(GripEntry {
                block: (r.required(o, at, "block", |r, n, at| r.text(n, at))).unwrap_or_default(),
                at: point(r, o, at, "at"),
            }))
        }
        _ => {
            r.wrong(node, at, Expected::Other("a string or an object"));
            None
        }
    }
}
