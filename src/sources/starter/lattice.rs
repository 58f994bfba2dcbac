//! [`LatticePile`]: a pile of triangles on the triangular lattice.

use super::STONE_DENSITY;
use crate::mechanics::scene::format::{BlockEntry, CellEntry, CellHalf, GridEntry, GridKind, GroundEntry, SceneFile};

/// A pile of triangular cells that point up and down alternately. Each row has one upward triangle fewer than the row
/// below.
///
/// Contacts on a lattice are computed exactly, from integer coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LatticePile {
    /// The number of rows, which is also the number of triangles that stand on the ground.
    pub rows: usize,
    /// Edge length of a cell, in metres.
    pub side: f64,
    /// Friction coefficient.
    pub friction: f64,
}

impl Default for LatticePile {
    /// Returns a pile of 3 rows of triangles with edges of 1 m and a friction coefficient of 0.7. It stands.
    fn default() -> LatticePile {
        LatticePile { rows: 3, side: 1.0, friction: 0.7 }
    }
}

impl LatticePile {
    /// Returns a scene file with the pile on the ground, of stone with 2500 kg/m³.
    ///
    /// # Example
    /// ```
    /// use drystone::{Analysis, Scene, analysis::Verdict, starter::LatticePile};
    /// let pile = |friction| Scene::new(LatticePile { friction, ..LatticePile::default() }.scene());
    /// assert_eq!(pile(0.7)?.blocks().len(), 9);
    /// assert_eq!(Analysis::new(&pile(0.7)?).verdict(), Verdict::Stable);
    /// assert_eq!(Analysis::new(&pile(0.05)?).verdict(), Verdict::Unstable);
    /// # Ok::<(), drystone::scene::SceneError>(())
    /// ```
    pub fn scene(&self) -> SceneFile {
        let up = |x: usize, y: f64| CellEntry::Triangle(x as f64, y, CellHalf::Up);
        let down = |x: usize, y: f64| CellEntry::Triangle(x as f64, y, CellHalf::Down);
        let mut blocks = Vec::new();
        for row in 0..self.rows {
            let (count, y) = (self.rows - row, row as f64);
            let cells = (0..count).map(|x| up(x, y)).chain((1..count).map(|x| down(x - 1, y + 1.0)));
            for cell in cells {
                blocks.push(BlockEntry { cells: Some(vec![cell]), ..BlockEntry::default() });
            }
        }
        // The ground is a strip of cells below y = 0. On the right it extends one side length beyond the pile.
        let strip = (0..=self.rows).flat_map(|x| [up(x, -1.0), down(x, 0.0)]);
        SceneFile {
            title: Some(format!("A pile of triangles in {} rows", self.rows)),
            friction: Some(self.friction),
            density: Some(STONE_DENSITY),
            grid: Some(GridEntry { kind: GridKind::Triangular, side: Some(self.side) }),
            ground: vec![GroundEntry { cells: Some(strip.collect()), ..GroundEntry::default() }],
            blocks,
            ..SceneFile::default()
        }
    }
}
