//! The sources of the published values, with full references.

/// Key, reference, and where the value was found. A text with "not checked" means that no value of this source was
/// checked.
pub const SOURCES: &[(&str, &str, &str)] = &[
    (
        "Ainley79",
        "S. Ainley, *Finely balanced*, The Mathematical Gazette 63 (1979), 272",
        "value found in a text about this article",
    ),
    (
        "Cocchetti20",
        "G. Cocchetti, E. Rizzi, *Analytical and numerical analysis on the collapse modes of least-thickness circular masonry arches at decreasing friction*, Frattura ed Integrità Strutturale 51 (2020), 356–375",
        "values found in table 3 of this article",
    ),
    (
        "Couplet1730",
        "P. Couplet, *Seconde partie de l'examen de la poussée des voûtes*, Mémoires de l'Académie Royale des Sciences, Paris 1730, 117–141",
        "value not checked",
    ),
    (
        "Ferris01",
        "M. C. Ferris, F. Tin-Loi, *Limit analysis of frictional block assemblies as a mathematical program with complementarity constraints*, International Journal of Mechanical Sciences 43 (2001), 209–224",
        "walls found in the examples of the program HybriDFEM; values not checked",
    ),
    (
        "Gilbert06",
        "M. Gilbert, C. Casapulla, H. M. Ahmed, *Limit analysis of masonry block structures with non-associative frictional joints using linear programming*, Computers & Structures 84 (2006), 873–887",
        "values not checked",
    ),
    (
        "Goodman76",
        "R. E. Goodman, J. W. Bray, *Toppling of rock slopes*, Proceedings of the Specialty Conference on Rock Engineering for Foundations and Slopes, ASCE, Boulder 1976, 201–234",
        "slope and values found in the joint verification problems of the program XSLOPE",
    ),
    (
        "Heyman69",
        "J. Heyman, *The safety of masonry arches*, International Journal of Mechanical Sciences 11 (1969), 363–385",
        "value found in a text about this article",
    ),
    (
        "HoekBray81",
        "E. Hoek, J. W. Bray, *Rock slope engineering*, third edition, Institution of Mining and Metallurgy, London 1981",
        "formula and value found in the examples of the program Lythos Kinematic",
    ),
    (
        "Housner63",
        "G. W. Housner, *The behavior of inverted pendulum structures during earthquakes*, Bulletin of the Seismological Society of America 53 (1963), 403–417",
        "formula found in texts about this article",
    ),
    (
        "Hua25",
        "Y. Hua, M. Buzzetti, N. Pingaro, L. C. M. da Silva, G. Milani, *A computerized tool for the kinematic limit analysis of 2D masonry structures failing on a tilting table*, the paper of the program LACT3, 2025",
        "arch and value found in the tests of the program",
    ),
    (
        "Kao22",
        "G. T.-C. Kao, A. Iannuzzo, B. Thomaszewski, S. Coros, T. Van Mele, P. Block, *Coupled rigid-block analysis: stability-aware design of complex discrete-element assemblies*, Computer-Aided Design 146 (2022), 103216",
        "models H and A found in the examples of the program compas_cra; answers not checked",
    ),
    (
        "MakrisVassiliou13",
        "N. Makris, M. F. Vassiliou, *Planar rocking response and stability analysis of an array of free-standing columns capped with a freely supported rigid beam*, Earthquake Engineering & Structural Dynamics 42 (2013), 431–449",
        "value not checked",
    ),
    (
        "MakrisAlexakis13",
        "N. Makris, H. Alexakis, *The effect of stereotomy on the shape of the thrust-line and the minimum thickness of semicircular masonry arches*, Archive of Applied Mechanics 83 (2013), 1511–1533",
        "value found in the abstract of this article",
    ),
    (
        "Milankovitch07",
        "M. Milankovitch, *Theorie der Druckkurven*, Zeitschrift für Mathematik und Physik 55 (1907), 1–27",
        "value found in the abstract of MakrisAlexakis13",
    ),
    (
        "NCERT",
        "National Council of Educational Research and Training, *Physics, textbook for class XI, part I*, New Delhi, example 6.9",
        "value found in a digital edition",
    ),
    (
        "Oppenheim92",
        "I. J. Oppenheim, *The masonry arch as a four-link mechanism under base motion*, Earthquake Engineering & Structural Dynamics 21 (1992), 1005–1017",
        "value not checked",
    ),
    (
        "Paterson09",
        "M. Paterson, U. Zwick, *Overhang*, The American Mathematical Monthly 116 (2009), 19–44",
        "values found in a study that repeats this work",
    ),
    (
        "RS2",
        "Rocscience, *RS2 joint verification manual*, problem 1, with the results of the distinct-element program UDEC",
        "value found in the joint verification problems of the program XSLOPE",
    ),
    (
        "Sinopoli97",
        "A. Sinopoli, M. Corradi, F. Foce, *Modern formulation for preelastic theories on masonry arches*, Journal of Engineering Mechanics 123 (1997), 204–213",
        "values not checked",
    ),
    (
        "Vallat23",
        "Vallat, *Physics simulator*, chapter of a thesis, 2023",
        "values computed with the program of the author",
    ),
    ("Weisstein", "E. W. Weisstein, *Book stacking problem*, MathWorld", "values found on this page of MathWorld"),
];
