//! [`chosen`]: which steps of a long scene a report draws.
//!
//! Hundreds of figures on one page are more than a browser lays out, and more than anybody looks at: the first and the last
//! step are drawn, those where the verdict becomes another, and others between, as evenly as they come.

use crate::analysis::Analysis;

/// Of more steps than this not all are drawn.
pub(super) const MOST: usize = 24;

/// Whether each step of an analysis is drawn.
pub(super) fn chosen(analysis: &Analysis) -> Vec<bool> {
    let verdicts: Vec<_> = analysis.frames.iter().map(|f| f.verdict).collect();
    let count = verdicts.len();
    if count <= MOST {
        return vec![true; count];
    }
    let mut chosen = vec![false; count];
    let changes = (1..count).filter(|i| verdicts[*i] != verdicts[*i - 1]);
    for step in [0, count - 1].into_iter().chain(changes).take(MOST) {
        chosen[step] = true;
    }
    // The middle of the longest stretch without a figure, until there are enough.
    for _ in chosen.iter().filter(|c| **c).count()..MOST {
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

/// What a page says of the steps that it does not draw; `None` where it draws all.
pub(super) fn left_out(analysis: &Analysis) -> Option<String> {
    let count = analysis.frames.len();
    (count > MOST).then(|| {
        format!(
            "Of {count} steps {MOST} are drawn here, with their tables: the first, the last, those where the verdict becomes \
             another, and some between. Of the others the verdict and its reasons are told; the commands at the end make \
             their figures and numbers."
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
        assert_eq!(drawn.iter().filter(|d| **d).count(), MOST);
        for step in [0, 41, 42, 99] {
            assert!(drawn[step], "step {step}");
        }
        assert!(drawn.windows(12).all(|some| some.contains(&true)));
        assert!(left_out(&analysis).is_some());
    }
}
