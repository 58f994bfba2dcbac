//! The names that a line of a batch may be asked for, in the order in which results have them.

use crate::scene;

/// A name and those of its parts, or of the parts of each of its entries.
#[derive(Debug)]
pub(super) struct Name {
    pub word: &'static str,
    pub parts: &'static [Name],
}

const fn leaf(word: &'static str) -> Name {
    Name { word, parts: &[] }
}

const fn with(word: &'static str, parts: &'static [Name]) -> Name {
    Name { word, parts }
}

/// Everything that may be asked for, `all` and `picture` apart.
pub(super) const NAMES: &[Name] = &[
    leaf("drystone"),
    leaf("scene"),
    leaf("verdict"),
    with(
        "contact_tolerance",
        &[
            leaf("gap"),
            leaf("from"),
            leaf("digits"),
            leaf("healed_within"),
            leaf("moved_corners"),
            leaf("largest_move"),
        ],
    ),
    with("frames", FRAME),
];

const FRAME: &[Name] = &[
    leaf("title"),
    leaf("verdict"),
    leaf("doubt"),
    leaf("length"),
    leaf("total_force"),
    leaf("total_force_least"),
    leaf("total_sticking"),
    leaf("weight"),
    with("interfaces", INTERFACE),
    with(
        "robots",
        &[
            leaf("id"),
            leaf("holds"),
            leaf("at"),
            leaf("force"),
            leaf("torque"),
            leaf("limit_used"),
        ],
    ),
    with("failures", FAILURE),
    leaf("unsupported"),
    with(
        "mechanism",
        &[leaf("block"), leaf("velocity"), leaf("spin")],
    ),
    leaf("margins"),
    leaf("only_by_wedging"),
    with(
        "effects",
        &[
            leaf("effect"),
            leaf("simulated"),
            leaf("why"),
            leaf("unknowns"),
        ],
    ),
    with("proof", PROOF),
    with(
        "solve",
        &[
            leaf("method"),
            leaf("iterations"),
            leaf("programs"),
            leaf("groups"),
            leaf("reused"),
            leaf("seconds"),
        ],
    ),
    leaf("notices"),
];

const INTERFACE: &[Name] = &[
    leaf("bodies"),
    leaf("kind"),
    leaf("ends"),
    leaf("application_points"),
    leaf("normal"),
    leaf("mu"),
    leaf("normal_forces"),
    leaf("friction_force"),
    with("resultant", &[leaf("at"), leaf("force")]),
    leaf("friction_used"),
];

const FAILURE: &[Name] = &[
    leaf("kind"),
    leaf("bodies"),
    leaf("robot"),
    leaf("holds"),
    leaf("at"),
    leaf("force"),
    leaf("torque"),
    leaf("amount"),
];

const PROOF: &[Name] = &[
    leaf("worst_imbalance"),
    leaf("worst_share"),
    leaf("worst_pull"),
    leaf("worst_slip"),
    leaf("power"),
    leaf("worst_violation"),
    leaf("no_balance_below"),
];

/// The path behind a name as it was typed.
pub(super) fn find(typed: &str) -> Option<Vec<&'static str>> {
    if typed == "all" {
        return Some(vec!["all"]);
    }
    let mut names = NAMES;
    let mut path = Vec::new();
    for word in typed.split('.') {
        let name = names.iter().find(|name| name.word == word)?;
        path.push(name.word);
        names = name.parts;
    }
    Some(path)
}

/// The nearest known name.
pub(super) fn nearest(typed: &str) -> Option<String> {
    let known = all();
    scene::nearest(typed, known.iter().map(String::as_str)).map(str::to_owned)
}

/// Every name, parts behind dots.
fn all() -> Vec<String> {
    fn add(names: &[Name], before: &str, list: &mut Vec<String>) {
        for name in names {
            let path = format!("{before}{}", name.word);
            add(name.parts, &format!("{path}."), list);
            list.push(path);
        }
    }
    let mut list = vec!["all".to_owned()];
    add(NAMES, "", &mut list);
    list
}
