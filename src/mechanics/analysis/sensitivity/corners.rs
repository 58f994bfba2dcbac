//! [`Corners`]: in which directions the corners of blocks can move, and which corners move with them, if no contact may
//! open.
//!
//! If corners of two bodies lie at the same end of their contact, they are one *joined corner*: they move together, and
//! both bodies change. If a corner of one body lies inside an edge of another body, this edge guides it. The corner can
//! move only along the edge. If the edge moves at right angles to itself, the corner moves with it. A corner that is
//! guided by two edges of different directions cannot move.

use super::elimination::{Elimination, ZERO_TOL};
use super::joints::{Corner, Finder, Guide, InterfaceCorners};
use crate::geometry::{Point, Vector, cross, quarter_turn};
use crate::mechanics::scene::{BodyId, Frame, Scene};
use crate::mechanics::statics::assembly::DisjointSets;
use crate::mechanics::statics::interface::{ContactKind, Interface};

/// Two directions count as parallel if the sine of the angle between them is at most this.
const PARALLEL_TOL: f64 = 1e-3;
/// If a group of dependent corners has more unknown displacements than this, none of its corners can move.
const MAX_DEPENDENT_UNKNOWNS: usize = 400;

/// One way in which a joined corner can move. Displacements are per metre of its own displacement.
#[derive(Clone, Debug)]
pub(super) struct Move {
    pub direction: Vector,
    /// The joined corners that move, and their displacements.
    pub field: Vec<(usize, Vector)>,
}

/// The corners that determine the ends and the normal of a contact.
#[derive(Clone, Copy, Debug)]
pub(super) struct ContactCorners {
    /// The joined corners at the two ends of the contact.
    pub ends: [usize; 2],
    /// The joined corners of the edge that determines the normal, if the contact is a corner on an edge.
    pub edge: Option<[usize; 2]>,
}

/// The corners of all bodies of a frame.
pub(super) struct Corners {
    pub all: Vec<Corner>,
    /// For each corner, the index of its joined corner. A corner that is joined with no other corner has an index of
    /// its own.
    pub joined: Vec<usize>,
    /// The number of joined corners.
    pub count: usize,
    /// The position of one corner of each joined corner, metres.
    pub positions: Vec<Point>,
    /// For each interface of the frame, the corners that determine it; `None` if they are unknown.
    pub contacts: Vec<Option<ContactCorners>>,
    /// The moves of each joined corner: two along the axes, one along an edge, or none.
    pub moves: Vec<Vec<Move>>,
}

impl Corners {
    /// Finds the corners of all bodies of a frame, and how they can move.
    pub fn new(scene: &Scene, frame: &Frame, interfaces: &[&Interface]) -> Corners {
        let mut finder = Finder::new(scene, frame);
        for interface in interfaces {
            finder.join(interface);
        }
        let contacts: Vec<InterfaceCorners> = interfaces.iter().map(|i| finder.contact(i)).collect();
        let (joined, count) = finder.joined();
        let guides = finder.guides(&joined);
        let mut corners = Corners {
            contacts: contacts
                .iter()
                .map(|found| {
                    found.ends.map(|ends| ContactCorners {
                        ends: ends.map(|corner| joined[corner]),
                        edge: found.edge.map(|edge| edge.map(|corner| joined[corner])),
                    })
                })
                .collect(),
            moves: vec![Vec::new(); count],
            positions: positions(&finder.all, &joined, count),
            all: finder.all,
            joined,
            count,
        };
        corners.find_moves(&guides);
        corners.freeze(&contacts, interfaces);
        corners
    }

    /// Returns the positions of the two neighbours of a corner in its outline, in metres.
    pub fn around(&self, place: usize) -> [Point; 2] {
        self.all[place].neighbours.map(|place| self.all[place].at)
    }

    /// Finds the possible moves of every joined corner that belongs to a block.
    fn find_moves(&mut self, guides: &[Guide]) {
        let mut has_block = vec![false; self.count];
        for (corner, joined) in self.all.iter().zip(&self.joined) {
            has_block[*joined] |= matches!(corner.body, BodyId::Block(_));
        }
        let mut normals: Vec<Vec<Vector>> = vec![Vec::new(); self.count];
        for guide in guides {
            let known = &mut normals[guide.of];
            let is_new = |n: &Vector| cross(*n, guide.normal).abs() > PARALLEL_TOL;
            if known.is_empty() || (known.len() == 1 && known.iter().all(is_new)) {
                known.push(guide.normal);
            }
        }
        for corner in (0..self.count).filter(|corner| has_block[*corner]) {
            let directions = match normals[corner].as_slice() {
                [] => vec![Vector::new(1.0, 0.0), Vector::new(0.0, 1.0)],
                [normal] => vec![quarter_turn(*normal)],
                _ => Vec::new(),
            };
            let moves = directions.into_iter().map(|direction| Move { direction, field: vec![(corner, direction)] });
            self.moves[corner] = moves.collect();
        }
        for part in independent_groups(guides, self.count) {
            self.follow(&part, &normals);
        }
    }

    /// Adds to each move the displacements of the corners that must follow it, because they lie on moving edges.
    /// Removes moves for which these corners cannot stay on their edges.
    fn follow(&mut self, guides: &[Guide], normals: &[Vec<Vector>]) {
        // The unknowns are the displacements of corners on edges: along the normal of one edge, or along x and y if
        // there are several edges.
        let mut guided: Vec<usize> = guides.iter().map(|guide| guide.of).collect();
        guided.sort_unstable();
        guided.dedup();
        let mut unknowns: Vec<(usize, Vector)> = Vec::new();
        for corner in guided {
            match normals[corner].as_slice() {
                [normal] => unknowns.push((corner, *normal)),
                _ => unknowns.extend([(corner, Vector::new(1.0, 0.0)), (corner, Vector::new(0.0, 1.0))]),
            }
        }
        let mut involved: Vec<usize> = guides.iter().flat_map(|g| [g.of, g.from, g.to]).collect();
        involved.sort_unstable();
        involved.dedup();
        if unknowns.len() > MAX_DEPENDENT_UNKNOWNS {
            involved.iter().for_each(|c| self.moves[*c].clear());
            return;
        }
        let row = |guide: &Guide| -> Vec<f64> {
            let entry = |(corner, along): &(usize, Vector)| guide.factor(*corner) * guide.normal.dot(along);
            unknowns.iter().map(entry).collect()
        };
        let rows: Vec<Vec<f64>> = guides.iter().map(row).collect();
        let moved: Vec<(usize, usize)> =
            involved.iter().flat_map(|c| (0..self.moves[*c].len()).map(|k| (*c, k))).collect();
        // Without followers, a move violates the conditions of the guides. The displacements of the followers must
        // compensate for this.
        let right_hand_side = |(corner, k): &(usize, usize)| -> Vec<f64> {
            let direction = self.moves[*corner][*k].direction;
            let violation = |g: &Guide| -g.factor(*corner) * g.normal.dot(&direction);
            guides.iter().map(violation).collect()
        };
        let sides: Vec<Vec<f64>> = moved.iter().map(right_hand_side).collect();
        let solved = Elimination::new(&rows, unknowns.len(), &sides);
        for ((corner, k), (solution, error)) in moved.into_iter().zip(solved.solutions) {
            let current = &mut self.moves[corner][k];
            if error > ZERO_TOL {
                current.field.clear();
                continue;
            }
            for ((follower, along), displacement) in unknowns.iter().zip(&solution) {
                if displacement.abs() > ZERO_TOL {
                    current.field.push((*follower, along * *displacement));
                }
            }
        }
        for corner in involved {
            if self.moves[corner].iter().any(|m| m.field.is_empty()) {
                self.moves[corner].clear();
            }
        }
    }

    /// Removes moves that rotate the normal of a contact of two corners, because the derivative of such a rotation is
    /// not computed. Also removes all moves of the two bodies of a contact whose end corners are unknown.
    fn freeze(&mut self, contacts: &[InterfaceCorners], interfaces: &[&Interface]) {
        let mut is_frozen = vec![false; self.count];
        for (found, interface) in contacts.iter().zip(interfaces) {
            let is_known = found.ends.is_some() && (interface.kind == ContactKind::Edge || found.edge.is_some());
            if is_known {
                continue;
            }
            for (place, corner) in self.all.iter().enumerate() {
                let is_tip = found.tips.contains(&place) || corner.neighbours.iter().any(|n| found.tips.contains(n));
                if is_tip || (found.ends.is_none() && interface.bodies.contains(&corner.body)) {
                    is_frozen[self.joined[place]] = true;
                }
            }
        }
        for moves in &mut self.moves {
            let stops = |m: &Move| m.field.iter().any(|(corner, _)| is_frozen[*corner]);
            if moves.iter().any(stops) {
                moves.clear();
            }
        }
    }
}

/// Returns the position of each joined corner in metres: the position of one of its corners.
fn positions(all: &[Corner], joined: &[usize], count: usize) -> Vec<Point> {
    let mut positions = vec![Point::origin(); count];
    for (corner, joined) in all.iter().zip(joined) {
        positions[*joined] = corner.at;
    }
    positions
}

/// Groups the guides, such that guides in different groups are independent of each other.
fn independent_groups(guides: &[Guide], count: usize) -> Vec<Vec<Guide>> {
    let mut is_guided = vec![false; count];
    guides.iter().for_each(|guide| is_guided[guide.of] = true);
    let mut sets = DisjointSets::new(count);
    for guide in guides {
        for end in [guide.from, guide.to] {
            if is_guided[end] {
                sets.union(guide.of, end);
            }
        }
    }
    let mut by_root: Vec<(usize, Guide)> = guides.iter().map(|g| (sets.find(g.of), *g)).collect();
    by_root.sort_by_key(|(root, _)| *root);
    let parts = by_root.chunk_by(|a, b| a.0 == b.0);
    parts.map(|part| part.iter().map(|(_, guide)| *guide).collect()).collect()
}
