//! [`Naming`]: decides from the names of elements which of them are ground or robots, and which are ignored.

use std::cell::RefCell;
use std::collections::BTreeSet;

use super::Options;
use super::choice::{Choice, Chosen};
use super::draft::Role;

/// Words that usually name the ground, in lower case. They are used only for drawings without other ground.
const GROUND_WORDS: &str = "abutment,abutments,bedrock,boden,earth,footing,footings,foundation,foundations,fundament,\
    pier base,pier bases,soil,sol,springing,suelo,support,supports,terrain,terreno,widerlager";
/// The largest number of names that are kept for messages.
const MAX_KEPT_NAMES: usize = 1000;

/// The rules that determine the roles of elements from their names.
#[derive(Debug, Default)]
pub(super) struct Naming<'o> {
    /// The values of `--ground` and `--ignore`, with the role that they give.
    chosen: Vec<(Role, &'o str)>,
    /// Whether a name such as "abutment" makes an element ground.
    guess: bool,
    /// The indices of the values in `chosen` that are names in the drawing.
    found: RefCell<BTreeSet<usize>>,
    /// The names that became ground because of a guess.
    guessed: RefCell<BTreeSet<String>>,
    seen: RefCell<BTreeSet<String>>,
}

impl<'o> Naming<'o> {
    pub(super) fn new(options: &'o Options, guess: bool) -> Naming<'o> {
        let ground = options.ground.iter().map(|value| (Role::Ground, value.as_str()));
        let ignored = options.ignore.iter().map(|value| (Role::Ignored, value.as_str()));
        Naming { chosen: ground.chain(ignored).collect(), guess, ..Naming::default() }
    }

    /// Returns the role of an element with this name. `None` if no role follows from the name.
    pub(super) fn role(&self, name: &str) -> Option<Role> {
        let name = name.trim();
        keep(&self.seen, name);
        let mut role = None;
        for (i, (chosen, value)) in self.chosen.iter().enumerate() {
            if same(value, name) {
                self.found.borrow_mut().insert(i);
                role = role.or(Some(*chosen));
            }
        }
        if role.is_none() && self.guess && is_ground_word(name) {
            keep(&self.guessed, name);
            role = Some(Role::Ground);
        }
        role.or_else(|| Role::from_name(name))
    }

    /// Returns the reason why elements are left out because of their names.
    pub(super) fn why_ignored(&self) -> &'static str {
        if self.chosen.iter().any(|(role, _)| *role == Role::Ignored) {
            "its name begins with ignore or guide, or is given with --ignore"
        } else {
            "its name begins with ignore or guide"
        }
    }

    /// Returns the names of elements that became ground because of a guess, in alphabetical order.
    pub(super) fn guessed(&self) -> Vec<String> {
        self.guessed.borrow().iter().cloned().collect()
    }

    /// Returns the names of elements and layers in the drawing, at most 1000, in alphabetical order.
    pub(super) fn seen(&self) -> Vec<String> {
        self.seen.borrow().iter().cloned().collect()
    }

    /// Returns the values of options that are not names in the drawing, but numbers, points or heights.
    ///
    /// # Errors
    /// Returns a message if a value is neither a name in the drawing nor one of these.
    pub(super) fn choices(&self) -> Result<Vec<Chosen<'o>>, String> {
        let found = self.found.borrow();
        let others = self.chosen.iter().enumerate().filter(|(i, _)| !found.contains(i));
        others
            .map(|(_, &(role, text))| match Choice::parse(text) {
                Some(choice) => Ok(Chosen { role, text, choice }),
                None => Err(self.unknown(text)),
            })
            .collect()
    }

    fn unknown(&self, name: &str) -> String {
        let names = self.seen();
        let near = crate::text::nearest(name, names.iter().map(String::as_str));
        let help = match (near, names.is_empty()) {
            (Some(near), _) => format!("did you mean `{near}`?"),
            (None, true) => "nothing in the drawing has a name".into(),
            (None, false) => format!("its names are {}", crate::text::first_of(names, super::MAX_NAMES)),
        };
        format!("no layer or element is called `{name}`; {help}")
    }
}

fn keep(names: &RefCell<BTreeSet<String>>, name: &str) {
    let mut names = names.borrow_mut();
    if !name.is_empty() && names.len() < MAX_KEPT_NAMES && !names.contains(name) {
        names.insert(name.to_owned());
    }
}

/// True if two names are equal, apart from upper and lower case.
fn same(a: &str, b: &str) -> bool {
    a.trim().to_lowercase() == b.trim().to_lowercase()
}

/// True if a name is a word for the ground, perhaps followed by a number or other words: `Abutments`, `support_2`.
fn is_ground_word(name: &str) -> bool {
    let name = name.to_lowercase();
    GROUND_WORDS
        .split(',')
        .any(|word| name.strip_prefix(word).is_some_and(|rest| !rest.starts_with(char::is_alphabetic)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_for_the_ground_are_guessed_on_request() {
        let options = Options::default();
        let guess = Naming::new(&options, true);
        for name in ["Abutments", "support_2", "Pier base left", "SOL", "Boden"] {
            assert_eq!(guess.role(name), Some(Role::Ground), "{name}");
        }
        for name in ["solid", "supporting", "pier", "stone", ""] {
            assert_eq!(guess.role(name), None, "{name}");
        }
        assert_eq!(guess.guessed().len(), 5);
        assert_eq!(Naming::default().role("Abutments"), None);
    }

    #[test]
    fn names_win_over_numbers() {
        let options =
            Options::default().ground(["Pfeiler", "3", "4"].map(String::from).to_vec()).ignore(vec!["below:2".into()]);
        let given = Naming::new(&options, false);
        assert_eq!((given.role("pfeiler "), given.role("3")), (Some(Role::Ground), Some(Role::Ground)));
        let choices: Vec<&str> = given.choices().expect("numbers").iter().map(|c| c.text).collect();
        assert_eq!(choices, ["4", "below:2"]);
        let options = Options::default().ground(vec!["Felse".into()]);
        let given = Naming::new(&options, false);
        given.role("Felsen");
        assert!(given.choices().expect_err("unknown").contains("did you mean `Felsen`?"));
    }
}
