//! Any bytes read as SVG, DXF, GeoJSON or well-known text are either imported as a valid scene or refused with a
//! message. Nothing panics.

#![no_main]

use drystone::Scene;
use drystone::import::{Format, Options, import};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    let text = String::from_utf8_lossy(bytes);
    for format in [Format::Svg, Format::Dxf, Format::GeoJson, Format::Wkt] {
        match import(&text, format, &Options::default()) {
            Ok(imported) => {
                assert!(!imported.scene.blocks.is_empty());
                assert!(Scene::from_json(&imported.scene.to_json()).is_ok());
            }
            Err(refusal) => assert!(refusal.problems.iter().any(|p| !p.message.is_empty())),
        }
    }
});
