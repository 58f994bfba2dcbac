//! Reads a scene file, prints its verdicts, and writes a figure.
//!
//! `cargo run --release --example render -- assets/thesis/figure-4.json figure-4.png`

#![allow(clippy::print_stdout, reason = "the example prints its results")]

use std::error::Error;
use std::{env, fs};

use drystone::{Analysis, Scene, figure, output};

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = env::args().skip(1);
    let (Some(input), Some(picture)) = (arguments.next(), arguments.next()) else {
        return Err("give two arguments: a scene file, and the path of the figure to write".into());
    };
    let scene = Scene::from_slice(&fs::read(input)?)?;
    let analysis = Analysis::new(&scene);
    println!("{:?}", analysis.frames.iter().map(|frame| frame.verdict).collect::<Vec<_>>());
    let svg = output::svg::write(&figure::forces(&analysis, &figure::Options::default()));
    fs::write(picture, output::png::render(&svg, output::png::Size::Width(1200))?)?;
    Ok(())
}
