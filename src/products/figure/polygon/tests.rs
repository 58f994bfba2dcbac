//! Tests of the force polygon.

use super::*;
use crate::mechanics::scene::format::UnitsEntry;

#[test]
fn the_legend_shows_each_scale_of_polygons_with_the_letters_of_its_panels() {
    let said = |scales: &[(usize, f64)]| -> Vec<(f64, String)> {
        let entries = scale_entries(scales, UnitsEntry::default().force()).into_iter();
        let said = entries.map(|entry| match entry {
            Entry::Scale(length, _, words) => (length, words),
            _ => panic!("an entry without an arrow"),
        });
        said.collect()
    };
    assert_eq!(said(&[]), []);
    // 64 pixels show 12.8 N, and the largest round force below is 10 N.
    let one = "arrow of 10 N in the force polygon".to_owned();
    assert_eq!(said(&[(0, 5.0)]), [(50.0, one)]);
    let both =
        [(50.0, "10 N in the polygons of (a) and (c)".to_owned()), (40.0, "20 N in the polygon of (b)".to_owned())];
    assert_eq!(said(&[(0, 5.0), (1, 2.0), (2, 5.0)]), both);
}
