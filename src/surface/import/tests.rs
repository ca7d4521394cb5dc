//! Readers against other people's readers, against files made by hand, and against damaged files.

use super::*;
use crate::mesh::Mesh;
use core::fmt::Write as _;
use ply_rs_bw::parser::Parser;
use ply_rs_bw::ply::{DefaultElement, Property};
use proptest::prelude::*;
use std::io::Cursor;

type Triangle = [[f32; 3]; 3];

fn binary_stl(header: &str, triangles: &[Triangle]) -> Vec<u8> {
    let mut bytes = vec![b' '; 80];
    bytes[..header.len()].copy_from_slice(header.as_bytes());
    bytes.extend((triangles.len() as u32).to_le_bytes());
    for corner in triangles {
        bytes.extend([0; 12]);
        for number in corner.iter().flatten() {
            bytes.extend(number.to_le_bytes());
        }
        bytes.extend([0; 2]);
    }
    bytes
}

fn text_stl(triangles: &[Triangle]) -> Vec<u8> {
    let mut text = String::from("solid facet of a part\n");
    for corners in triangles {
        text += " facet normal 0 0 1\n  outer loop\n";
        for [x, y, z] in corners {
            writeln!(text, "   vertex {x} {y:e} {z}").unwrap();
        }
        text += "  endloop\n endfacet\n";
    }
    (text + "endsolid facet of a part\n").into_bytes()
}

/// The triangles of a mesh corner by corner.
fn soup(mesh: &Mesh) -> Vec<[[f64; 3]; 3]> {
    mesh.faces().map(|face| face.map(|p| p.to_array())).collect()
}

fn two() -> Vec<Triangle> {
    let [a, b, c, d] = [
        [0.0, 0.0, 1.0],
        [10.0, 0.0, 2.0],
        [10.0, 5.0, 3.5],
        [0.0, 5.0, -0.0],
    ];
    vec![[a, b, c], [a, c, d]]
}

fn text_obj() -> &'static str {
    "# made by hand\nmtllib x.mtl\no part\nv 0 0 1\nv 10 0 2\r\nv 10 5 3.5 1.0\nv 0 5 0\nvn 0 0 1\nvt 0 0\n\
     f 1/1/1 2//1 3\nf -4 -2 \\\n -1 # and so on\ns off\n"
}

fn text_ply() -> &'static str {
    "ply\nformat ascii 1.0\ncomment made by hand\nelement vertex 4\nproperty uchar red\nproperty double x\nproperty float y\n\
     property list uchar float more\nproperty float z\nelement face 2\nproperty list uchar int vertex_indices\n\
     element edge 1\nproperty int vertex1\nproperty int vertex2\nend_header\n\
     1 0 0 0 1\n2 10 0 1 7 2\n3 10 5 0 3.5\n255 0 5 2 8 9 0\n3 0 1 2\n3 0 2 3\n0 1\n"
}

/// The same data as [`text_ply`], in bytes.
fn binary_ply(order: &str) -> Vec<u8> {
    let text = text_ply();
    let (head, body) = text.split_at(text.find("end_header\n").unwrap() + 11);
    let mut bytes = head.replace("ascii", order).into_bytes();
    let is_big = order == "binary_big_endian";
    let push = |bytes: &mut Vec<u8>, mut number: Vec<u8>| {
        if is_big {
            number.reverse();
        }
        bytes.extend(number);
    };
    let mut numbers = body.split_whitespace();
    let mut next = || numbers.next().unwrap();
    for _ in 0..4 {
        bytes.push(next().parse().unwrap());
        push(&mut bytes, next().parse::<f64>().unwrap().to_le_bytes().into());
        push(&mut bytes, next().parse::<f32>().unwrap().to_le_bytes().into());
        let count: u8 = next().parse().unwrap();
        bytes.push(count);
        for _ in 0..=count {
            push(&mut bytes, next().parse::<f32>().unwrap().to_le_bytes().into());
        }
    }
    for _ in 0..2 {
        bytes.push(next().parse().unwrap());
        for _ in 0..3 {
            push(&mut bytes, next().parse::<i32>().unwrap().to_le_bytes().into());
        }
    }
    for _ in 0..2 {
        push(&mut bytes, next().parse::<i32>().unwrap().to_le_bytes().into());
    }
    bytes
}

fn all_files() -> Vec<Vec<u8>> {
    vec![
        binary_stl("solid", &two()),
        text_stl(&two()),
        text_obj().into(),
        b"x,y,z\n0,0,1\n10,0,2.5\n0,5,3\n10,5,-4\n".into(),
        text_ply().into(),
        binary_ply("binary_little_endian"),
        binary_ply("binary_big_endian"),
    ]
}

#[test]
fn all_files_hold_the_same_triangles() {
    let wanted = soup(&stl(&binary_stl("solid x", &two())).unwrap().mesh);
    assert_eq!(
        wanted,
        two()
            .iter()
            .map(|t| t.map(|p| p.map(f64::from)))
            .collect::<Vec<_>>()
    );
    assert_eq!(soup(&stl(&text_stl(&two())).unwrap().mesh), wanted);
    let read = obj(text_obj().as_bytes()).unwrap();
    assert_eq!(soup(&read.mesh), wanted);
    let passed_over: Vec<_> = read
        .remarks
        .passed_over
        .iter()
        .map(|(n, k)| (n.as_str(), *k))
        .collect();
    assert_eq!(
        passed_over,
        [("mtllib", 1), ("o", 1), ("s", 1), ("vn", 1), ("vt", 1)]
    );
    for file in [
        text_ply().as_bytes().to_vec(),
        text_ply().replace('\n', "\r\n").into_bytes(),
        binary_ply("binary_little_endian"),
        binary_ply("binary_big_endian"),
    ] {
        let read = ply(&file).unwrap();
        assert_eq!(soup(&read.mesh), wanted);
        assert_eq!(read.remarks.passed_over.get("edge"), Some(&1));
    }
}

#[test]
fn equal_corners_are_one() {
    let mesh = stl(&binary_stl("", &two())).unwrap().mesh;
    assert_eq!((mesh.corners().len(), mesh.triangles().len()), (4, 2));
}

#[test]
fn odd_triangles_are_left_out_and_reported() {
    let mut triangles = two();
    let [a, b, c] = triangles[0];
    triangles.extend([[b, c, a], [a, a, b], [a, [5.0, 0.0, 1.5], b]]);
    let read = stl(&binary_stl("", &triangles)).unwrap();
    assert_eq!((read.remarks.doubled, read.remarks.degenerate), (1, 2));
    assert_eq!(read.mesh.triangles().len(), 2);
}

#[test]
fn texts_may_begin_with_a_byte_order_mark() {
    let plain = text_stl(&two());
    let marked = [b"\xEF\xBB\xBF".as_slice(), &plain].concat();
    assert_eq!(stl(&marked), stl(&plain));
}

#[test]
fn other_files_named_as_stl_are_called_by_their_form() {
    let message = |bytes: &[u8]| stl(bytes).unwrap_err().message;
    for mark in ["", "\u{feff}"] {
        assert!(message(format!("{mark}{}", text_obj()).as_bytes()).contains("`.obj`"));
        assert!(message(format!("{mark}{}", text_ply()).as_bytes()).contains("`.ply`"));
    }
    // A binary file that was cut off is not one of them.
    let mut cut = binary_stl("v of a vane", &two());
    cut.pop();
    assert!(message(&cut).contains("promises 2"));
}

#[test]
fn polygons_become_fans() {
    let corners = "v 0 0 0\nv 4 0 0\nv 4 4 0\nv 2 1 0\nv 0 4 0\nv 2 8 0\nv 1 1 1\n";
    let read = |faces: &str| obj((corners.to_owned() + faces).as_bytes());
    assert_eq!(read("f 1 2 3 6 5").unwrap().mesh.triangles().len(), 3);
    // Hollow at corner 4, which sees all others.
    let concave = read("f 1 2 3 4 5").unwrap();
    let area: f64 = soup(&concave.mesh)
        .iter()
        .map(|[a, b, c]| ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])) / 2.0)
        .sum();
    assert_eq!(area, 10.0);
    let bent = read("f 1 2 3 5\nf 7 2 3 5").unwrap().remarks;
    assert_eq!(bent.bent, 1);
    assert!((0.2..0.5).contains(&bent.most_bent), "{}", bent.most_bent);
    assert!(read("f 1 2 1 3 5").unwrap_err().message.contains("twice"));
    assert_eq!(read("f 1 2 2 3").unwrap().mesh.triangles(), [[0, 1, 2]]);
    let comb = "v 0 0 0\nv 9 0 0\nv 9 9 0\nv 8 9 0\nv 8 1 0\nv 5 1 0\nv 5 9 0\nv 4 9 0\nv 4 1 0\nv 1 1 0\nv 1 9 0\nv 0 9 0\n\
                f 1 2 3 4 5 6 7 8 9 10 11 12";
    assert!(obj(comb.as_bytes()).unwrap_err().message.contains("concave"));
}

/// The bytes that a refusal points at, and why.
fn refusal(read: Result<ReadMesh, DataError>) -> (core::ops::Range<usize>, String) {
    let error = read.unwrap_err();
    (error.start as usize..error.end as usize, error.message)
}

#[test]
fn faults_are_pointed_at() {
    let mut file = binary_stl("solid", &two());
    file[84 + 50 + 24..][..4].copy_from_slice(&f32::NAN.to_le_bytes());
    assert_eq!(refusal(stl(&file)).0, 84 + 50 + 24..84 + 50 + 36);
    let mut file = binary_stl("part", &two());
    file[80..84].copy_from_slice(&u32::MAX.to_le_bytes());
    let (range, message) = refusal(stl(&file));
    assert_eq!(range, 80..84);
    assert!(message.contains("4294967295"), "{message}");
    assert!(stl(b"").is_err() && stl(b"solid").is_err() && stl(&[7; 84]).is_err());

    let shown = |text: &str, read: fn(&[u8]) -> Result<ReadMesh, DataError>| {
        text[refusal(read(text.as_bytes())).0].to_owned()
    };
    assert_eq!(
        shown("solid x\nfacet normal 0 0 1 outer loop vertex 1 2 nan", stl),
        "nan"
    );
    assert_eq!(shown("solid x\nface normal", stl), "face");
    assert_eq!(shown("v 0 0 0\nv 1 0 0\nv 0 1 1e40\nf 1 2 3", obj), "1e40");
    assert_eq!(shown("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4", obj), "4");
    assert_eq!(shown("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 -4", obj), "-4");
    assert_eq!(shown("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 0 1 2", obj), "0");
    assert_eq!(shown("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2", obj), "f 1 2");
    assert_eq!(shown("v 0 0\n", obj), "v 0 0");
    let broken = text_ply().replace("3 0 2 3", "3 0 2 4");
    assert_eq!(shown(&broken, ply).trim(), "4");
    assert_eq!(shown("ply\nformat ascii 2\nelement x\n", ply), "element x");
    let without = text_ply().replace("float z", "float height");
    assert_eq!(shown(&without, ply), "element vertex 4");
}

#[test]
fn counts_without_data_make_no_room() {
    for form in ["ascii", "binary_little_endian"] {
        for count in ["4294967295", "9223372036854775807"] {
            let head = format!(
                "ply\nformat {form} 1.0\nelement nothing {count}\nelement vertex {count}\nproperty char x\nproperty char y\n\
                 property char z\nend_header\n1 2 3"
            );
            assert!(refusal(ply(head.as_bytes())).1.contains("ends before"), "{head}");
        }
        let list = format!(
            "ply\nformat {form} 1.0\nelement vertex 0\nproperty char x\nproperty char y\nproperty char z\n\
             element face 1\nproperty list uint uint vertex_indices\nend_header\n~~~~"
        );
        assert!(ply(list.as_bytes()).is_err());
    }
}

#[test]
fn heights_read_the_same_in_all_forms() {
    let wanted = heights(b"0,0,1\n10,0,2.5\n0,5,3\n10,5,-4\n").unwrap();
    assert_eq!((wanted.corners().len(), wanted.triangles().len()), (4, 2));
    for text in [
        "x [mm], y [mm], z [mm]\n# measured\n\n10, 5, -4 # last\n0, 5, 3\n10, 0, 2.5\n0, 0, 1",
        "\u{feff}10;5;-4,0\r\n0;5;3\r\n10;0;2,5\r\n0;0;1\r\n",
        "10\t5\t\t-4\n0\t5\t3\n10\t0\t2,5\n0\t0\t1",
        "  10   5 -4 \n 0 5 3\n1e1 0 25e-1\n0 0 1",
    ] {
        assert_eq!(heights(text.as_bytes()).unwrap(), wanted, "{text:?}");
    }
    let complaint = |text: &str| {
        let error = heights(text.as_bytes()).unwrap_err();
        (
            text[error.start as usize..error.end as usize].to_owned(),
            error.message,
        )
    };
    assert_eq!(complaint("0,0,1\n1,0").0, "1,0");
    assert_eq!(complaint("0,0,1\n1,0,abc\n").0, "abc");
    assert_eq!(complaint("0;0;1\n1;;2\n").1, "a number is missing here");
    assert_eq!(complaint("0 0 1\n0 0 2\n1 0 3\n0 1 4\n1 1 5").0, "0 0 2");
    assert_eq!(
        complaint("0 0 1\n1 0 3\n0 1 4").1,
        "the grid has no height at x = 1, y = 1"
    );
}

/// What `ply-rs-bw` reads: corners, and faces of three.
fn by_ply_rs(file: &[u8]) -> Vec<[[f64; 3]; 3]> {
    let read = Parser::<DefaultElement>::new()
        .read_ply(&mut Cursor::new(file))
        .unwrap();
    let number = |item: &DefaultElement, name: &str| match item[name] {
        Property::Float(value) => f64::from(value),
        Property::Double(value) => value,
        _ => panic!("{name}"),
    };
    let corners: Vec<[f64; 3]> = read.payload["vertex"]
        .iter()
        .map(|item| ["x", "y", "z"].map(|name| number(item, name)))
        .collect();
    let faces = read.payload["face"].iter();
    faces
        .map(|item| match &item["vertex_indices"] {
            Property::ListInt(named) => core::array::from_fn(|i| corners[named[i] as usize]),
            other => panic!("{other:?}"),
        })
        .collect()
}

#[test]
fn ply_rs_reads_the_same() {
    for file in [
        text_ply().as_bytes().to_vec(),
        binary_ply("binary_little_endian"),
        binary_ply("binary_big_endian"),
    ] {
        assert_eq!(soup(&ply(&file).unwrap().mesh), by_ply_rs(&file));
    }
}

fn coordinate() -> impl Strategy<Value = f32> {
    prop_oneof![
        -1000.0..1000.0f32,
        (0..4u8).prop_map(f32::from),
        Just(-0.0),
        Just(1e-30)
    ]
}

fn triangles() -> impl Strategy<Value = Vec<Triangle>> {
    prop::collection::vec(prop::array::uniform3(prop::array::uniform3(coordinate())), 1..40)
}

/// Triangles without those that readers leave out, judged in single precision by exact products in double precision.
fn proper(triangles: &[Triangle]) -> Vec<[[f64; 3]; 3]> {
    let mut seen = std::collections::BTreeSet::new();
    let exact = triangles.iter().map(|t| t.map(|p| p.map(|v| f64::from(v) + 0.0)));
    exact
        .filter(|[a, b, c]| {
            let [u, v]: [[f64; 3]; 2] = [b, c].map(|p| core::array::from_fn(|i| p[i] - a[i]));
            (0..3).any(|i| u[i] * v[(i + 1) % 3] != u[(i + 1) % 3] * v[i])
        })
        .filter(|t| {
            let mut key = t.map(|p| p.map(f64::to_bits));
            key.sort_unstable();
            seen.insert(key)
        })
        .collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn stl_io_reads_the_same(triangles in triangles()) {
        for file in [binary_stl("solid of a kind", &triangles), text_stl(&triangles)] {
            // stl_io takes every file that begins with `solid` for text.
            let mut theirs = file.clone();
            if theirs[80..84] == (triangles.len() as u32).to_le_bytes() {
                theirs[..5].copy_from_slice(b"other");
            }
            let theirs = stl_io::read_stl(&mut Cursor::new(theirs)).unwrap();
            let theirs: Vec<Triangle> = theirs.into_triangle_vec().iter().map(|t| t.vertices.map(|v| v.0)).collect();
            let wanted = proper(&theirs);
            match stl(&file) {
                Ok(read) => {
                    prop_assert_eq!(soup(&read.mesh), wanted);
                    let seen = read.remarks.degenerate + read.remarks.doubled + read.mesh.triangles().len();
                    prop_assert_eq!(seen, triangles.len());
                }
                Err(_) => prop_assert!(wanted.is_empty()),
            }
        }
    }

    #[test]
    fn tobj_reads_the_same(
        corners in prop::collection::vec(prop::array::uniform3(coordinate()), 3..30),
        faces in prop::collection::vec((0..30usize, 0..30usize, 0..30usize, any::<bool>()), 1..40),
    ) {
        let mut text = String::new();
        for [x, y, z] in &corners {
            writeln!(text, "v {x} {y} {z}").unwrap();
        }
        let count = corners.len();
        let mut named = Vec::new();
        for &(a, b, c, back) in &faces {
            let face = [a % count, b % count, c % count];
            let [a, b, c] = face.map(|i| if back { i as i64 - count as i64 } else { i as i64 + 1 });
            writeln!(text, "f {a} {b} {c}").unwrap();
            named.push(face);
        }
        let options = tobj::LoadOptions { triangulate: true, ..Default::default() };
        let (models, _) =
            tobj::load_obj_buf(&mut Cursor::new(&text), &options, |_| Err(tobj::LoadError::OpenFileFailed)).unwrap();
        let theirs: Vec<Triangle> = models.iter().flat_map(|model| {
            let (faces, _) = model.mesh.indices.as_chunks::<3>();
            faces.iter().map(|face| face.map(|i| core::array::from_fn(|k| model.mesh.positions[i as usize * 3 + k])))
        }).collect();
        // Doubles where tobj has singles: equal after rounding. Corners may be equal without having one number in an OBJ.
        match obj(text.as_bytes()) {
            Ok(read) => {
                let kept = soup(&read.mesh).len() + read.remarks.degenerate + read.remarks.doubled;
                prop_assert_eq!(kept, theirs.len());
                let ours: Vec<Triangle> = soup(&read.mesh).iter().map(|t| t.map(|p| p.map(|v| v as f32))).collect();
                let mut rest = theirs.iter();
                for triangle in &ours {
                    prop_assert!(rest.any(|other| other == triangle));
                }
            }
            Err(_) => prop_assert!(proper(&theirs).is_empty()),
        }
    }
}

proptest! {
    // Seven files in four readers each: over 10,000 damaged files a reader.
    #![proptest_config(ProptestConfig::with_cases(1800))]

    #[test]
    fn damaged_files_are_refused_within_their_bytes(
        changes in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>(), 0..4u8), 1..6),
    ) {
        for mut file in all_files() {
            for (place, byte, how) in &changes {
                if file.is_empty() {
                    break;
                }
                let at = place.index(file.len());
                match how {
                    0 => file[at] = *byte,
                    1 => file[at] = b"0123456789-e. \n"[usize::from(*byte) % 15],
                    2 => file.truncate(at),
                    _ => { let piece = file[at..].to_vec(); file.splice(at..at, piece.into_iter().take(usize::from(*byte))); }
                }
            }
            let grid = |bytes: &[u8]| heights(bytes).map(|mesh| ReadMesh { mesh, remarks: Remarks::default() });
            for read in [stl, obj, ply, grid] {
                match read(&file) {
                    Ok(read) => {
                        let used = read.mesh.corners().len() * 24 + read.mesh.triangles().len() * 12;
                        prop_assert!(used <= 4 * file.len(), "{used} of {}", file.len());
                    }
                    Err(error) => {
                        prop_assert!(error.start <= error.end && error.end as usize <= file.len());
                        prop_assert!(!error.message.is_empty());
                    }
                }
            }
        }
    }
}
