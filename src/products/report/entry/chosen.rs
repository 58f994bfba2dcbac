//! [`chosen`]: selects the steps of a long scene that a report draws.
//!
//! A browser cannot lay out hundreds of figures on one page, and nobody looks at them. A report draws the first and the
//! last step, the steps at which the verdict changes, and others spread evenly between them.

use crate::analysis::Analysis;

/// A report draws at most this many steps.
pub(super) const MAX_DRAWN_STEPS: usize = 24;

/// For each step, whether it is drawn.
pub(super) fn chosen(analysis: &Analysis) -> Vec<bool> {
    let verdicts: Vec<_> = analysis.frames.iter().map(|f| f.verdict).collect();
    let count = verdicts.len();
    if count <= MAX_DRAWN_STEPS {
        return vec![true; count];
    }
    let mut chosen = vec![false; count];
    let changes = (1..count).filter(|i| verdicts[*i] != verdicts[*i - 1]);
    for step in [0, count - 1]
        .into_iter()
        .chain(changes)
        .take(MAX_DRAWN_STEPS)
    {
        chosen[step] = true;
    }
    // Add the middle of the longest gap until there are enough figures.
    for _ in chosen.iter().filter(|c| **c).count()..MAX_DRAWN_STEPS {
        let drawn: Vec<usize> = (0..count).filter(|i| chosen[*i]).collect();
        let gaps = drawn.windows(2).map(|pair| (pair[0], pair[1]));
        let longest = gaps.fold((0, 0), |best, gap| {
            if gap.1 - gap.0 > best.1 - best.0 {
                gap
            } else {
                best
            }
        });
        chosen[(longest.0 + longest.1) / 2] = true;
    }
    chosen
}

/// A sentence about the steps that are not drawn; `None` if all are.
pub(super) fn left_out(analysis: &Analysis) -> Option<String> {
    let count = analysis.frames.len();
    (count > MAX_DRAWN_STEPS).then(|| {
        format!(
            "{MAX_DRAWN_STEPS} of {count} steps are drawn here, with their tables: the first, the last, those at which the verdict \
             changes, and some between. The others are listed with their verdict and its reasons. The commands at the end \
             make their figures and numbers."
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Scene;

    #[test]
    fn the_first_the_last_and_every_change_of_verdict_are_drawn() {
        let mut steps = String::from(r#"{ "place": ["a"] }"#);
        for step in 1..100 {
            let step = match step {
                41 => r#", { "remove": ["a"], "place": ["b"] }"#,
                42 => r#", { "remove": ["b"], "place": ["a"] }"#,
                _ => ", {}",
            };
            steps.push_str(step);
        }
        let text = format!(
            r#"{{ "drystone": 1, "ground": [{{ "polygon": [[0,0],[9,0],[9,-1],[0,-1]] }}],
            "blocks": [{{ "id": "a", "polygon": [[1,0],[2,0],[2,1],[1,1]] }},
                       {{ "id": "b", "polygon": [[1,3],[2,3],[2,4],[1,4]] }}], "steps": [{steps}] }}"#
        );
        let scene = Scene::from_json(&text).expect("a scene");
        let analysis = Analysis::new(&scene);
        let drawn = chosen(&analysis);
        assert_eq!(drawn.iter().filter(|d| **d).count(), MAX_DRAWN_STEPS);
        for step in [0, 41, 42, 99] {
            assert!(drawn[step], "step {step}");
        }
        assert!(drawn.windows(12).all(|some| some.contains(&true)));
        assert!(left_out(&analysis).is_some());
    }
}
