//! `vcutc convert`: rasters of many post processors become the tips they stand for, and what is not a raster
//! is refused with its line.

mod posts;
mod refusals;

use crate::repository::{read, root};
use posts::{PASSES, Post, Raster, STYLES, Style, ZEROS, Zero};
use proptest::prelude::*;
use vcutc::convert::asked::{Asked, Words};
use vcutc::convert::{Conversion, Request, convert};
use vcutc_backend_api::readback::ProgramFile;

/// The blank of [Cui 2020], table 1, and its optimum.
fn paper() -> Raster {
    Raster::block([85.0, 50.0, 50.0], 4.4, 5.97, 13.0)
}

const WORDS: Words<'static> = Words {
    rake: "60deg",
    swing: "34.16deg",
    extension: "8mm",
    stock: "85x50x50",
    origin: None,
    along: None,
    up: None,
    feed_unit: None,
    feed: None,
    travel: None,
    reorient: None,
    clearance: None,
    edge: None,
    half_apex: None,
    thickness: None,
    tolerance: None,
};

fn request<'a>(files: &'a [ProgramFile], asked: &'a Asked) -> Request<'a> {
    Request {
        files,
        asked,
        name: "raster",
        cell: None,
        machine: None,
        blade: None,
        profile: None,
    }
}

fn converted(files: &[ProgramFile], words: Words<'_>) -> Conversion {
    let asked = words.asked().unwrap();
    convert(request(files, &asked)).unwrap_or_else(|refused| panic!("{:#?}", refused.diagnostics))
}

fn tips(conversion: &Conversion) -> Vec<[f64; 2]> {
    conversion
        .raster
        .passes
        .iter()
        .map(|pass| [pass.x, pass.z])
        .collect()
}

fn all_posts() -> impl Iterator<Item = Post> {
    STYLES.into_iter().flat_map(|style| {
        ZEROS
            .into_iter()
            .flat_map(move |zero| PASSES.map(|passes| Post { style, zero, passes }))
    })
}

/// Without the comments, which name lines of the program.
fn without_comments(text: &str) -> String {
    let lines = text.lines().filter(|line| !line.trim_start().starts_with("//"));
    lines.collect::<Vec<_>>().join("\n")
}

/// The panel of `docs/convert.md`: the blank and the parameters of [Cui 2020], over a hill.
fn panel() -> Raster {
    let mut raster = paper();
    let part = |x: f64| 20.0 - 7.0 * libm::cos(x / 85.0 * core::f64::consts::TAU);
    let slope = 1.0 / libm::tan(34.16_f64.to_radians());
    let clears = |x: f64, z: f64| {
        (0..=850).all(|i| {
            let beside = f64::from(i) / 10.0;
            part(beside) <= z + slope * (beside - x).abs()
        })
    };
    for (z, columns) in &mut raster.rows {
        columns.retain(|&x| clears(x, *z));
    }
    raster.rows.retain(|(_, columns)| !columns.is_empty());
    raster
}

/// Its program, and both paths as they are drawn.
const PANEL: (&str, &str) = ("examples/milling/panel.src", "docs/images/panel_paths.svg");

#[test]
fn the_panel_of_the_documentation_is_a_raster() {
    let post = Post {
        style: Style::Full,
        zero: Zero::Corner,
        passes: PASSES[0],
    };
    let files = post.write(&panel());
    let path = root().join(PANEL.0);
    if std::env::var_os("UPDATE_DOCS").is_some() {
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(
            &path,
            files[0].text.replace("\r\n", "\n").replace("raster", "panel"),
        )
        .unwrap();
    }
    assert_eq!(
        read(PANEL.0),
        files[0].text.replace("\r\n", "\n").replace("raster", "panel")
    );
    assert_eq!(tips(&converted(&files, WORDS)), panel().tips());
}

#[test]
fn all_posts_come_to_one_job() {
    let raster = paper();
    let mut first: Option<String> = None;
    for post in all_posts() {
        let conversion = converted(&post.write(&raster), WORDS);
        assert_eq!(tips(&conversion), raster.tips(), "{post:?}");
        let job = without_comments(&conversion.job.text);
        assert_eq!(first.get_or_insert_with(|| job.clone()), &job, "{post:?}");
    }
}

#[test]
fn every_tip_knows_the_line_that_it_stands_for() {
    let post = Post {
        style: Style::Full,
        zero: Zero::Corner,
        passes: PASSES[0],
    };
    let conversion = converted(&post.write(&paper()), WORDS);
    assert_eq!(conversion.job.origins.len(), conversion.raster.passes.len());
    for (origin, pass) in conversion.job.origins.iter().zip(&conversion.raster.passes) {
        let said = conversion.sources.slice(origin.said);
        assert!(said.contains(&format!("X {:.3},", pass.x)), "{said}");
        assert!(said.contains(&format!("Z {:.3},", pass.z)), "{said}");
        let tip = &conversion.job.text[origin.at.clone()];
        assert!(tip.starts_with(&format!("({} mm, ", pass.x)), "{tip}");
    }
}

/// The optimum of [Cui 2020] needs the edge of 10 mm that the paper gives it [Cui 4].
#[test]
fn the_least_edge_is_that_of_the_paper() {
    let conversion = converted(
        &Post {
            style: Style::Full,
            zero: Zero::Corner,
            passes: PASSES[0],
        }
        .write(&paper()),
        WORDS,
    );
    let needed = conversion
        .inferences
        .iter()
        .find_map(|inference| inference.what.strip_prefix("cutting_length = "))
        .unwrap();
    let needed: f64 = needed.trim_end_matches(" mm").parse().unwrap();
    assert!((needed - 10.0).abs() < 0.01, "{needed}");
}

#[test]
fn units_of_speeds_are_found_or_asked_for() {
    let post = Post {
        style: Style::Full,
        zero: Zero::Corner,
        passes: PASSES[0],
    };
    let mut files = post.write(&paper());
    files[0].text = files[0]
        .text
        .replace("$VEL.CP=0.2", "$VEL.CP=12000")
        .replace("$VEL.CP=1.0", "$VEL.CP=60000");
    let job = converted(&files, WORDS).job.text;
    assert!(job.contains("cut = 200 mm/s, travel = 1000 mm/s"), "{job}");
    files[0].text = files[0].text.replace("12000", "200").replace("60000", "1000");
    let said = Words {
        feed_unit: Some("mm/s"),
        ..WORDS
    };
    let job = converted(&files, said).job.text;
    assert!(job.contains("cut = 200 mm/s, travel = 1000 mm/s"), "{job}");
}

#[test]
fn other_axes_may_point_up() {
    // The program's x is the job's z, its z the job's y and its y the job's x: a rotation.
    let mut files = Post {
        style: Style::Full,
        zero: Zero::Corner,
        passes: PASSES[0],
    }
    .write(&paper());
    let turned: Vec<String> = files[0]
        .text
        .lines()
        .map(|line| match line.strip_prefix("LIN {X ") {
            Some(rest) => {
                let mut parts = rest.split(',');
                let (x, y, z) = (
                    parts.next().unwrap(),
                    parts.next().unwrap(),
                    parts.next().unwrap(),
                );
                format!("LIN {{X {},Y {x},Z {}}}", &z[2..], &y[2..])
            }
            None => line.to_owned(),
        })
        .collect();
    files[0].text = turned.join("\n");
    let conversion = converted(
        &files,
        Words {
            up: Some("x"),
            ..WORDS
        },
    );
    assert_eq!(tips(&conversion), paper().tips());
}

#[test]
fn passes_that_are_made_twice_are_one() {
    let mut files = Post {
        style: Style::Full,
        zero: Zero::Corner,
        passes: PASSES[0],
    }
    .write(&paper());
    // Every pass of the first row goes back and there again.
    files[0].text = files[0].text.replace(
        "LIN {X 6.680,Y -3.000,Z 45.600,A 0.0,B 90.0,C 0.0} C_DIS ; cut\r\n",
        "LIN {X 6.680,Y -3.000,Z 45.600,A 0.0,B 90.0,C 0.0}\r\nLIN {X 6.680,Y 53.000,Z 45.600,A 0.0,B 90.0,C 0.0}\r\n\
         LIN {X 6.680,Y -3.000,Z 45.600,A 0.0,B 90.0,C 0.0}\r\n",
    );
    assert_eq!(tips(&converted(&files, WORDS)), paper().tips());
}

/// The program of the paper's block with a change, as one file.
fn changed(change: impl Fn(String) -> String) -> Vec<ProgramFile> {
    let post = Post {
        style: Style::Full,
        zero: Zero::Corner,
        passes: PASSES[0],
    };
    let mut files = post.write(&paper());
    files[0].text = change(files[0].text.replace("\r\n", "\n"));
    files
}

fn inferred<'a>(conversion: &'a Conversion, subject: &str) -> Vec<&'a str> {
    let of_subject = conversion
        .inferences
        .iter()
        .filter(|inference| inference.subject == subject);
    of_subject.map(|inference| inference.what.as_str()).collect()
}

/// What posts write around and after motions, and what changes none of them.
#[test]
fn words_around_motions_change_no_pass() {
    let head = "PDAT_ACT={VEL 15,ACC 100,APO_DIST 50}\nFDAT_ACT={TOOL_NO 13,BASE_NO 1,IPO_FRAME #BASE}\nBAS (#FRAMES)\n\
        BAS (#VEL_PTP,15)\nPTP $POS_ACT\nINT I\nDECL REAL VF\n$ADVANCE=5\n$APO.CDIS=0.5\nCONTINUE\n$VEL.CP=1.0\n";
    let changes: [&dyn Fn(String) -> String; 6] = [
        &|text| text.replace("C_DIS", "C_DIS C_DIS"),
        &|text| text.replacen("$VEL.CP=1.0\n", head, 1),
        &|text| {
            text.replace(
                "\nEND\n",
                "\nFDAT_ACT={TOOL_NO 0,BASE_NO 0}\nPTP {A1 0}\nRETURN\nEND\n",
            )
        },
        &|text| {
            text.replace("LIN {", "SLIN {")
                .replace("C_DIS", "WITH $ACC=SACC_CP(LCPDAT1), $JERK=SJERK(LCPDAT1) C_SPL")
        },
        &|text| text.replace("C 0.0}", "C 0.0,E1 250.0,E2 0.0}"),
        // Up by 5 mm and down again, along the base and along the tool, whose x points down.
        &|text| {
            text.replacen(
                "$VEL.CP=0.2\n",
                "LIN_REL {Z 5.0} C_DIS #BASE\nLIN_REL {X 5.0} #TOOL\n\
                 CIRC {X 0.71,Y 25,Z 75},{X 0.71,Y 53,Z 60}\nCIRC_REL {Y -28,Z 15},{Y -56}\n$VEL.CP=0.2\n",
                1,
            )
        },
    ];
    for (number, change) in changes.into_iter().enumerate() {
        let conversion = converted(&changed(change), WORDS);
        assert_eq!(tips(&conversion), paper().tips(), "{number}");
        assert!(
            conversion.warnings.is_empty(),
            "{number}: {:#?}",
            conversion.warnings
        );
        match number {
            4 => assert_eq!(
                inferred(&conversion, "external"),
                ["external axes do not move: E1 at 250, E2 at 0"]
            ),
            5 => assert_eq!(conversion.raster.arcs, 2),
            _ => {}
        }
    }
}

/// Ways that pass no uncut material: full circles in the air, and ways down where V-cuts have been, or beside the blank.
#[test]
fn ways_in_the_air_stay_what_they_are() {
    let ways = [
        // A full circle, one the other way round, and two turns, all above the blank.
        "LIN {X 20.0,Y 20.0,Z 65.0}\nCIRC {X 30.0,Y 30.0,Z 65.0},{X 40.0,Y 20.0,Z 65.0}, CA 360\n\
         CIRC {X 30.0,Y 30.0,Z 65.0},{X 40.0,Y 20.0,Z 65.0}, CA -360\n\
         SCIRC {X 30.0,Y 30.0,Z 65.0},{X 40.0,Y 20.0,Z 65.0}, CA 720\n",
        // Down into the hollow that all passes have left, and up again.
        "LIN {X 0.71,Y 25.0,Z 60.0}\nLIN {Z 14.8}\nLIN {Z 60.0}\nPTP HOME\nPTP {X 0.71,Y 25.0,Z 14.8}\nLIN {Z 60.0}\n",
        // Along the passes, below the top, but before the blank.
        "LIN {X 40.0,Y -30.0,Z 60.0}\nLIN {Z 20.0}\nLIN {Y -10.0}\nLIN {Y -3.0,Z 60.0}\n",
    ];
    for way in ways {
        let conversion = converted(
            &changed(|text| text.replace("\nEND\n", &format!("\n{way}END\n"))),
            WORDS,
        );
        assert_eq!(tips(&conversion), paper().tips(), "{way}");
        assert!(
            conversion.warnings.is_empty(),
            "{way}: {:#?}",
            conversion.warnings
        );
    }
}

/// Noise up to the tolerance does not change the passes, and is reported.
#[test]
fn noise_of_posts_is_swallowed_up_to_the_tolerance() {
    let noisy = changed(|text| {
        let mut out = String::new();
        let mut last = String::new();
        for line in text.lines() {
            let part = |line: &str, from: &str| -> Option<f64> {
                line.split(from).nth(1)?.split([',', '}']).next()?.parse().ok()
            };
            let here = (part(line, "{X "), part(line, "Z "));
            if let (Some(x), Some(z)) = here
                && here == (part(&last, "{X "), part(&last, "Z "))
                && part(line, "Y ") != part(&last, "Y ")
            {
                out += &format!(
                    "LIN {{X {:.3},Y 20,Z {:.3}}}\nLIN {{X {:.3},Y 30,Z {z:.3}}}\n",
                    x + 0.03,
                    z - 0.01,
                    x - 0.02
                );
            }
            out += line;
            out.push('\n');
            last = line.to_owned();
        }
        out
    });
    let asked = WORDS.asked().unwrap();
    let refused = convert(request(&noisy, &asked)).unwrap_err();
    let help = format!("{:?}", refused.diagnostics);
    assert!(
        help.contains("--tolerance 0.05mm") || help.contains("--tolerance 0.1mm"),
        "{help}"
    );
    let words = Words {
        tolerance: Some("0.06"),
        ..WORDS
    };
    let conversion = converted(&noisy, words);
    for (found, made) in tips(&conversion).iter().zip(paper().tips()) {
        assert!(
            (found[0] - made[0]).abs() <= 0.03 && (found[1] - made[1]).abs() <= 0.03,
            "{found:?} {made:?}"
        );
    }
    assert_eq!(conversion.raster.passes.len(), paper().tips().len());
    let inferred_tolerances = inferred(&conversion, "tolerance");
    assert!(
        inferred_tolerances.len() == 1 && inferred_tolerances[0].contains("0.025 mm"),
        "{inferred_tolerances:?}"
    );
}

fn any_raster() -> impl Strategy<Value = Raster> {
    let sizes = (20.0..200.0_f64, 20.0..200.0_f64, 20.0..80.0_f64);
    (sizes, 2.0..8.0_f64, 2.0..12.0_f64, 0.0..9.0_f64, 1.0..30.0_f64).prop_map(
        |((width, depth, height), layer, step, overrun, safe)| {
            let whole = |mm: f64| (mm * 10.0).round() / 10.0;
            let blank = [whole(width), whole(depth), whole(height)];
            let mut raster = Raster::block(blank, layer, step, height / 3.0);
            raster.overrun = whole(overrun);
            raster.safe = whole(safe);
            raster
        },
    )
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(96))]

    #[test]
    fn rasters_come_back_as_they_are(raster in any_raster(), post in 0_usize..45) {
        let post = all_posts().nth(post).unwrap();
        // A raster of fewer passes than are long is cut along the other axis by mistake; it has to be said.
        let along = match post.zero {
            Zero::Corner | Zero::MiddleOfTop => "y",
            Zero::AlongX => "x",
        };
        let [width, depth, height] = raster.blank;
        let stock = format!("{width}x{depth}x{height}");
        let words = Words { stock: &stock, along: Some(along), ..WORDS };
        let conversion = converted(&post.write(&raster), words);
        let (found, made) = (tips(&conversion), raster.tips());
        prop_assert_eq!(found.len(), made.len());
        for (found, made) in found.iter().zip(&made) {
            prop_assert!((found[0] - made[0]).abs() < 0.0011 && (found[1] - made[1]).abs() < 0.0011, "{:?} {:?}", found, made);
        }
    }
}
