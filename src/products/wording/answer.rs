//! Describes the answers to the questions about a frame: a sentence for each, as the terminal and reports print it.

use super::{capacity, question};
use crate::mechanics::analysis::SolvedFrame;

/// Returns what the answers to the questions about a frame say, each with the name of its question.
pub fn sentences(solved: SolvedFrame<'_>) -> Vec<(&'static str, String)> {
    let SolvedFrame { scene, found, .. } = solved;
    let mut told = Vec::new();
    told.extend(found.placement.as_ref().map(|own| ("placement", question::placement_sentence(solved, own))));
    told.extend(question::movement_sentences(solved).into_iter().map(|words| ("movement", words)));
    told.extend(
        found.removable.as_ref().map(|rows| ("removable", question::removable_phrases(scene, rows).join("; "))),
    );
    told.extend(found.vehicle.as_ref().map(|influence| ("vehicle", question::vehicle_sentence(scene, influence))));
    if let Some(own) = &found.capacity {
        let governed = question::conditions(found, own.edges.iter().map(|edge| edge.condition));
        let governed = governed.map(|names| format!("; governed by {names}")).unwrap_or_default();
        told.push(("capacity", format!("{}{governed}", capacity::clauses(scene, found.verdict, own).join("; "))));
    }
    told
}
