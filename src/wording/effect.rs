//! Effects in a reader's words.

/// What an effect is, by its name in results; empty for a name that is none.
pub fn meaning(effect: &str) -> &'static str {
    match effect {
        "weight" => "each block is pulled along gravity at its centroid",
        "contact" => {
            "blocks press on each other and on the ground where edges touch, and never pull"
        }
        "friction" => "what is pressed resists sliding, up to μ times the pressing force",
        "kernel" => "forces keep away from the ends of interfaces",
        "robots" => "robots hold blocks with a force, up to their limits",
        "robot torque" => "robots also turn what they hold, up to their limits",
        "loads" => "forces and torques from outside, as the scene lists them",
        "corner contacts" => "corners that touch carry force too",
        "sticking" => {
            "the least that would have to be glued, or robots to give beyond their limits, for it to stand"
        }
        "mechanism" => "the motion by which it falls",
        "margins" => "how far it is from the edge of standing",
        "wedging" => "whether it stands only by a stress of its own that its loads do not build up",
        _ => "",
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::analysis::Analysis;
    use crate::scene::Scene;

    #[test]
    fn every_effect_that_is_reported_has_a_meaning() {
        let scene = Scene::from_json(
            r#"{ "drystone": 1, "blocks": [{ "id": "a", "polygon": [[0, 0], [1, 0], [0, 1]] }] }"#,
        )
        .expect("sound");
        let analysis = Analysis::of(&scene);
        let effects = &analysis.frames[0].effects;
        assert!(effects.len() >= 12);
        for effect in effects {
            assert_ne!(meaning(effect.effect), "", "{}", effect.effect);
        }
    }
}
