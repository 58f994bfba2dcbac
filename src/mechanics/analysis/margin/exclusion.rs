//! [`Exclusion`]: a range of values of a parameter in which a frame falls by the same motion.
//!
//! If a frame stands at no value of a parameter, a few exclusions cover all values: one exclusion of all values, two
//! exclusions if two components stand only at different values, or arcs of tilts.

use crate::mechanics::proof::Motion;

/// The values of a parameter at which a frame falls by one motion. An end is `None` if the range is unbounded there.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Exclusion {
    /// The lower end.
    pub from: Option<f64>,
    /// The upper end.
    pub to: Option<f64>,
    /// How the blocks begin to move at these values.
    pub mechanism: Vec<Motion>,
}

impl Exclusion {
    /// Creates the exclusion of all values: the frame falls by this motion at every value of the parameter.
    pub(super) fn everywhere(mechanism: Vec<Motion>) -> Exclusion {
        Exclusion { from: None, to: None, mechanism }
    }

    /// Creates the exclusion of all values below `to`, where the frame falls by this motion.
    pub(super) fn below(to: f64, mechanism: Vec<Motion>) -> Exclusion {
        Exclusion { to: Some(to), ..Exclusion::everywhere(mechanism) }
    }

    /// Creates the exclusion of all values above `from`, where the frame falls by this motion.
    pub(super) fn above(from: f64, mechanism: Vec<Motion>) -> Exclusion {
        Exclusion { from: Some(from), ..Exclusion::everywhere(mechanism) }
    }
}

/// Selects as few arcs of tilts as possible that together cover a full turn, sorted by their beginning. Angles are in
/// degrees. Two arcs count as joined if the gap between them is at most `gap(tilt)`, where `tilt` is the end of the
/// first arc. Returns all arcs if they do not cover a full turn.
pub(super) fn fewest_arcs(arcs: &[Exclusion], gap: impl Fn(f64) -> f64) -> Vec<Exclusion> {
    let ends = |arc: &Exclusion| {
        let [from, to] = [arc.from, arc.to];
        (from.unwrap_or(f64::NEG_INFINITY), to.unwrap_or(f64::INFINITY))
    };
    let first = arcs.iter().map(|arc| ends(arc).0);
    let (first, mut kept) = (first.fold(f64::INFINITY, f64::min), Vec::new());
    let mut reached = first;
    while reached < first + 360.0 {
        // Of the arcs that begin within the covered range, choose the arc that ends farthest.
        let joined = arcs.iter().filter(|arc| ends(arc).0 <= reached + gap(reached));
        let farthest = joined.max_by(|a, b| ends(a).1.total_cmp(&ends(b).1));
        match farthest.filter(|arc| ends(arc).1 > reached) {
            Some(arc) => {
                reached = ends(arc).1;
                kept.push(arc.clone());
            }
            None => return arcs.to_vec(),
        }
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;

    fn arc(from: f64, to: f64) -> Exclusion {
        Exclusion { from: Some(from), to: Some(to), mechanism: Vec::new() }
    }

    #[test]
    fn a_full_turn_is_covered_by_the_fewest_arcs() {
        let all = vec![arc(-10.0, 60.0), arc(20.0, 40.0), arc(50.0, 170.0), arc(55.0, 120.0), arc(-190.0, -9.0)];
        let found = fewest_arcs(&all, |_| 1e-6);
        assert_eq!(found, [all[4].clone(), all[0].clone(), all[2].clone()], "{found:?}");
        let open = &all[..4];
        assert_eq!(fewest_arcs(open, |_| 1e-6), open);
    }
}
