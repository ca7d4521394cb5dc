//! A small reader of KRL, written from the manuals and not from the writer: it runs the modules of a bundle
//! and reports what the robot would do.
//!
//! It is strict where a controller is: unknown names, a `LIN` from nowhere, a declaration in a `.src`, a missing data
//! list or a wrong number stop it.

use std::collections::BTreeMap;
use vcutc_backend_api::bundle::Bundle;

/// Rows of a rotation matrix.
pub(crate) type Matrix = [[f64; 3]; 3];

/// A frame in mm and as a matrix.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Pose {
    pub(crate) tip: [f64; 3],
    pub(crate) axes: Matrix,
}

/// A frame that was set by value or by number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Setting {
    Value(Pose),
    Number(u32),
}

/// Something the robot does.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Event {
    /// A move of all axes to where they should be.
    Axes([f64; 6]),
    /// A move of all axes to a pose, with status and turn.
    Point {
        to: Pose,
        status: u32,
        turn: u32,
    },
    Line {
        to: Pose,
        /// A place on the way of an arc.
        via: Option<[f64; 3]>,
        /// `$VEL.CP` in m/s.
        feed: f64,
        /// `$VEL.ORI1` and `$VEL.ORI2` in deg/s, which a move that turns the blade must have.
        rates: Option<(f64, f64)>,
        rounded: bool,
    },
    Output(u32, bool),
    Await(u32),
    Wait(f64),
    Tool(Setting),
    Base(Setting),
    /// Another blade is put in: from this place, or by hand.
    Change(Option<u32>),
    /// A module begins.
    Module(String),
}

/// Runs the module `name`.
pub(crate) fn run(bundle: &Bundle, name: &str) -> Result<Vec<Event>, String> {
    let mut robot = Robot {
        bundle,
        events: Vec::new(),
        feed: None,
        rates: (None, None),
        rounding: None,
        has_axis_speed: false,
        knows_pose: false,
        axes: None,
        depth: 0,
    };
    robot.module(name)?;
    Ok(robot.events)
}

struct Robot<'b> {
    bundle: &'b Bundle,
    events: Vec<Event>,
    feed: Option<f64>,
    rates: (Option<f64>, Option<f64>),
    rounding: Option<f64>,
    has_axis_speed: bool,
    knows_pose: bool,
    /// How the tool is turned, where the program has said so.
    axes: Option<Matrix>,
    depth: u32,
}

/// Variables of a data list.
type Data = BTreeMap<String, String>;

impl Robot<'_> {
    fn module(&mut self, name: &str) -> Result<(), String> {
        if self.depth > 1 {
            return Err("calls nest".to_owned());
        }
        self.depth += 1;
        self.events.push(Event::Module(name.to_owned()));
        // Whoever starts a module, its first motion must say where to and how.
        self.knows_pose = false;
        let data = self.data(name)?;
        let lines = self.file(name, "src")?;
        let mut folds: Vec<String> = Vec::new();
        let mut place = Place::Marks;
        for (number, line) in (1..).zip(&lines) {
            let located = |problem: String| format!("{name}.src:{number}: {problem}: {line}");
            if let Some(mark) = line.strip_prefix('&') {
                if place != Place::Marks || mark.is_empty() {
                    return Err(located("a mark after the first lines".into()));
                }
                continue;
            }
            let line = line.trim();
            if let Some(fold) = line.strip_prefix(";FOLD ") {
                folds.push(fold.to_owned());
            } else if let Some(end) = line.strip_prefix(";ENDFOLD") {
                let open = folds.pop().ok_or_else(|| located("no fold is open".into()))?;
                if end.trim() != format!("({open})") {
                    return Err(located(format!("the fold {open} is open")));
                }
            }
            let code = line.split(';').next().unwrap_or_default().trim();
            if code.is_empty() {
                if place == Place::Marks {
                    return Err(located("text before DEF".into()));
                }
                continue;
            }
            place = self.statement(name, &data, place, code).map_err(located)?;
        }
        self.depth -= 1;
        match (place, folds.is_empty()) {
            (Place::Ended, true) => Ok(()),
            (_, false) => Err(format!("{name}: folds stay open")),
            (_, true) => Err(format!("{name}: no END")),
        }
    }

    fn statement(&mut self, name: &str, data: &Data, place: Place, code: &str) -> Result<Place, String> {
        match place {
            Place::Marks => {
                let def = code.strip_prefix("DEF ").ok_or("no DEF")?;
                return if def.trim_end_matches("( )").eq_ignore_ascii_case(name) {
                    Ok(Place::Declarations)
                } else {
                    Err("DEF and file have different names".into())
                };
            }
            Place::Declarations => {
                if let Some(part) = code.strip_prefix("EXT ") {
                    self.file(part.trim_end_matches("( )"), "src")?;
                    return Ok(Place::Declarations);
                }
                if code != "BAS (#INITMOV,0 )" {
                    return Err("a program begins with its initialisation".into());
                }
                self.feed = None;
                self.rates = (None, None);
                self.rounding = None;
                self.has_axis_speed = false;
                return Ok(Place::Instructions);
            }
            Place::Instructions => {}
            Place::Ended => return Err("text after END".into()),
        }
        if code == "END" {
            return Ok(Place::Ended);
        }
        self.instruction(data, code)?;
        Ok(Place::Instructions)
    }

    fn instruction(&mut self, data: &Data, code: &str) -> Result<(), String> {
        if let Some(target) = code.strip_prefix("PTP ").or(code.strip_prefix("SPTP ")) {
            return self.axes(data, target);
        }
        if let Some(rest) = code.strip_prefix("LIN ").or(code.strip_prefix("SLIN ")) {
            return self.line(rest, if code.starts_with('S') { "C_SPL" } else { "C_DIS" });
        }
        if let Some(rest) = code.strip_prefix("CIRC ").or(code.strip_prefix("SCIRC ")) {
            let (via, rest) = rest.split_once("},").ok_or("an arc without an end")?;
            let via = format!("{via}}}");
            let via = aggregate(&via)?;
            let names: Vec<&str> = via.keys().copied().collect();
            if names != ["X", "Y", "Z"] {
                return Err(format!("a place of {names:?}"));
            }
            self.line(rest, if code.starts_with('S') { "C_SPL" } else { "C_DIS" })?;
            if let Some(Event::Line { via: known, .. }) = self.events.last_mut() {
                *known = Some(["X", "Y", "Z"].map(|name| via[name]));
            }
            return Ok(());
        }
        if let Some(rest) = code.strip_prefix("WAIT ") {
            let event = match rest.split_once(' ') {
                Some(("FOR", input)) => Event::Await(index(input, "$IN")?),
                Some(("SEC", time)) => Event::Wait(decimal(time)?),
                _ => return Err("an unknown wait".into()),
            };
            self.events.push(event);
            return Ok(());
        }
        if code == "HALT" {
            self.events.push(Event::Change(None));
            return Ok(());
        }
        if let Some(place) = code
            .strip_prefix("CHANGE_TOOL(")
            .and_then(|rest| rest.strip_suffix(')'))
        {
            let place = place.parse().map_err(|_| "a place that is not a number")?;
            self.events.push(Event::Change(Some(place)));
            return Ok(());
        }
        if let Some(call) = code.strip_suffix("( )").filter(|call| !call.contains(' ')) {
            return self.module(call);
        }
        if let Some(rest) = code
            .strip_prefix("BAS (#")
            .and_then(|rest| rest.strip_suffix(" )"))
        {
            return self.bas(rest);
        }
        let (variable, value) = code.split_once('=').ok_or("an unknown instruction")?;
        self.assign(variable, value)
    }

    fn axes(&mut self, data: &Data, target: &str) -> Result<(), String> {
        if !self.has_axis_speed {
            return Err("a axis move without a speed".into());
        }
        self.knows_pose = true;
        if target.starts_with('{') {
            let event = point(target)?;
            if let Event::Point { to, .. } = event {
                self.axes = Some(to.axes);
            }
            self.events.push(event);
            return Ok(());
        }
        let value = data.get(target).ok_or("an unknown point")?;
        let parts = aggregate(value)?;
        let axes = ["A1", "A2", "A3", "A4", "A5", "A6"];
        let mut angles = [0.0; 6];
        for (angle, axis) in angles.iter_mut().zip(axes) {
            *angle = *parts.get(axis).ok_or("an axis is missing")?;
        }
        self.axes = None;
        self.events.push(Event::Axes(angles));
        Ok(())
    }

    fn line(&mut self, rest: &str, approximate: &str) -> Result<(), String> {
        if !self.knows_pose {
            return Err("a line from nowhere".into());
        }
        let (literal, word) = match rest.split_once('}') {
            Some((literal, word)) => (format!("{literal}}}"), word.trim()),
            None => return Err("a target without an end".into()),
        };
        let rounded = match word {
            "" => false,
            word if word == approximate => true,
            other => return Err(format!("{other} after a target")),
        };
        if rounded && self.rounding.is_none_or(|distance| distance <= 0.0) {
            return Err("rounding without a distance".into());
        }
        let to = pose(&literal)?;
        let turns = self.axes.replace(to.axes).is_some_and(|before| before != to.axes);
        let feed = self.feed.ok_or("a move without speed")?;
        let rates = match self.rates {
            _ if !turns => None,
            (Some(swivel), Some(twist)) => Some((swivel, twist)),
            rates => return Err(format!("a turning move with rates {rates:?}")),
        };
        self.events.push(Event::Line {
            to,
            via: None,
            feed,
            rates,
            rounded,
        });
        Ok(())
    }

    fn bas(&mut self, call: &str) -> Result<(), String> {
        let (command, number) = call.split_once(',').ok_or("BAS without a number")?;
        let number: u32 = number.parse().map_err(|_| "BAS with what is not a number")?;
        match (command, number) {
            ("TOOL", 1..=16) => self.events.push(Event::Tool(Setting::Number(number))),
            ("BASE", 1..=32) => self.events.push(Event::Base(Setting::Number(number))),
            ("VEL_PTP", 1..=100) => self.has_axis_speed = true,
            _ => return Err("an unknown BAS command".into()),
        }
        Ok(())
    }

    fn assign(&mut self, variable: &str, value: &str) -> Result<(), String> {
        match variable {
            "$VEL.CP" => self.feed = Some(positive(value)?),
            "$VEL.ORI1" => self.rates.0 = Some(positive(value)?),
            "$VEL.ORI2" => self.rates.1 = Some(positive(value)?),
            "$APO.CDIS" => self.rounding = Some(positive(value)?),
            "$TOOL" => self.events.push(Event::Tool(Setting::Value(pose(value)?))),
            "$BASE" => self.events.push(Event::Base(Setting::Value(pose(value)?))),
            "$LOAD" => load(value)?,
            "$IPO_MODE" if value == "#BASE" => {}
            "$ORI_TYPE" if value == "#VAR" => {}
            "$CIRC_TYPE" if value == "#PATH" => {}
            "$ADVANCE" if value == "3" => {}
            output if output.starts_with("$OUT[") => {
                let on = match value {
                    "TRUE" => true,
                    "FALSE" => false,
                    _ => return Err("an output that is neither on nor off".into()),
                };
                self.events.push(Event::Output(index(output, "$OUT")?, on));
            }
            _ => return Err("an unknown variable or value".into()),
        }
        Ok(())
    }

    fn data(&self, name: &str) -> Result<Data, String> {
        let mut data = Data::new();
        let lines = self.file(name, "dat")?;
        let mut code = lines
            .iter()
            .map(String::as_str)
            .filter(|line| !line.starts_with(['&', ';']));
        if code.next() != Some(&format!("DEFDAT {name}")) {
            return Err(format!("{name}.dat has another name"));
        }
        for line in code.by_ref() {
            if line == "ENDDAT" {
                break;
            }
            if line == "EXT BAS (BAS_COMMAND :IN,REAL :IN )" {
                continue;
            }
            let (variable, value) = line
                .strip_prefix("DECL E6AXIS ")
                .and_then(|rest| rest.split_once('='))
                .ok_or_else(|| format!("{name}.dat: {line}"))?;
            data.insert(variable.to_owned(), value.to_owned());
        }
        match code.next() {
            None => Ok(data),
            Some(line) => Err(format!("{name}.dat: after ENDDAT: {line}")),
        }
    }

    fn file(&self, name: &str, extension: &str) -> Result<Vec<String>, String> {
        let file = format!("{name}.{extension}");
        let bytes = self.bundle.get(&file).ok_or(format!("{file} is missing"))?;
        let text = std::str::from_utf8(bytes).map_err(|error| error.to_string())?;
        Ok(text.lines().map(str::to_owned).collect())
    }
}

#[derive(Clone, Copy, PartialEq)]
enum Place {
    Marks,
    Declarations,
    Instructions,
    Ended,
}

/// `{NAME value,NAME value}`, flat.
fn aggregate(text: &str) -> Result<BTreeMap<&str, f64>, String> {
    let inner = text
        .strip_prefix('{')
        .and_then(|rest| rest.strip_suffix('}'))
        .ok_or(format!("{text} is no aggregate"))?;
    let mut parts = BTreeMap::new();
    for part in inner.split(',') {
        let (name, value) = part.split_once(' ').ok_or(format!("{part} has no value"))?;
        if parts.insert(name, decimal(value)?).is_some() {
            return Err(format!("{name} is there twice"));
        }
    }
    Ok(parts)
}

fn load(text: &str) -> Result<(), String> {
    if let Some(number) = text.strip_prefix("LOAD_DATA") {
        let number = index(number, "")?;
        return if (1..=16).contains(&number) {
            Ok(())
        } else {
            Err(format!("load {number}"))
        };
    }
    let (mass, rest) = text
        .strip_prefix("{M ")
        .and_then(|rest| rest.split_once(",CM "))
        .ok_or("no load")?;
    let (centre, inertia) = rest
        .strip_suffix('}')
        .and_then(|rest| rest.split_once(",J "))
        .ok_or("no inertia")?;
    positive(mass)?;
    pose(centre)?;
    aggregate(inertia)?;
    Ok(())
}

/// X, Y, Z and R = Rz(A) Ry(B) Rx(C), multiplied out by hand.
#[expect(clippy::disallowed_methods, reason = "another sine than the writer's")]
fn pose(text: &str) -> Result<Pose, String> {
    let parts = aggregate(text)?;
    let names: Vec<&str> = parts.keys().copied().collect();
    if names != ["A", "B", "C", "X", "Y", "Z"] {
        return Err(format!("a pose of {names:?}"));
    }
    let [sin_a, sin_b, sin_c] = ["A", "B", "C"].map(|name| parts[name].to_radians().sin());
    let [cos_a, cos_b, cos_c] = ["A", "B", "C"].map(|name| parts[name].to_radians().cos());
    Ok(Pose {
        tip: ["X", "Y", "Z"].map(|name| parts[name]),
        axes: [
            [
                cos_a * cos_b,
                cos_a * sin_b * sin_c - sin_a * cos_c,
                cos_a * sin_b * cos_c + sin_a * sin_c,
            ],
            [
                sin_a * cos_b,
                sin_a * sin_b * sin_c + cos_a * cos_c,
                sin_a * sin_b * cos_c - cos_a * sin_c,
            ],
            [-sin_b, cos_b * sin_c, cos_b * cos_c],
        ],
    })
}

/// A pose with status and turn, both of them sums of bits.
fn point(text: &str) -> Result<Event, String> {
    let (frame, bits) = text.split_once(",S ").ok_or("a pose without status")?;
    let (status, turn) = bits
        .strip_suffix('}')
        .and_then(|bits| bits.split_once(",T "))
        .ok_or("a pose without turn")?;
    let bits = |text: &str, highest: u32| match text.parse() {
        Ok(bits) if bits <= highest && text == format!("{bits}") => Ok(bits),
        _ => Err(format!("{text} is no sum of bits")),
    };
    Ok(Event::Point {
        to: pose(&format!("{frame}}}"))?,
        status: bits(status, 7)?,
        turn: bits(turn, 63)?,
    })
}

/// Digits, a point, digits, perhaps a sign that means something.
fn decimal(text: &str) -> Result<f64, String> {
    let digits = text.strip_prefix('-').unwrap_or(text);
    let (whole, part) = digits.split_once('.').ok_or(format!("{text} has no point"))?;
    let plain = |digits: &str| !digits.is_empty() && digits.bytes().all(|byte| byte.is_ascii_digit());
    let zero = digits.bytes().all(|byte| matches!(byte, b'0' | b'.'));
    if !plain(whole) || !plain(part) || (zero && text.starts_with('-')) {
        return Err(format!("{text} is not a number"));
    }
    text.parse().map_err(|_| format!("{text} is not a number"))
}

fn positive(text: &str) -> Result<f64, String> {
    match decimal(text)? {
        value if value > 0.0 => Ok(value),
        value => Err(format!("{value} is not positive")),
    }
}

/// `NAME[n]`.
fn index(text: &str, name: &str) -> Result<u32, String> {
    text.strip_prefix(name)
        .and_then(|rest| rest.strip_prefix('['))
        .and_then(|rest| rest.strip_suffix(']'))
        .and_then(|number| number.parse().ok())
        .ok_or(format!("{text} is no {name}[n]"))
}
