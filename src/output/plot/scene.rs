//! The scene of a case before anything is solved: bodies, boundaries, supports, loads and contacts, each with its name.

use std::fmt::Write;

use plotters::style::RGBColor;

use super::labels::{Frame, Name, PlacedNames, escaped};
use super::outline::{line_data, loops, path_data, unmatched};
use super::palette::{BLUE, GREEN, GREY, INK, LINES, VERMILION};
use super::sheet::{AxisSpec, DrawResult, PIXEL, Scale, Sheet, line};
use super::ticks::Ticks;

/// Room for the plot (pixels).
const ROOM: [f64; 2] = [760.0, 600.0];
/// A plot is at least this large (pixels).
const LEAST: [f64; 2] = [360.0, 240.0];
/// Room for marks and names around the bodies (pixels).
const AROUND: f64 = 74.0;
/// Distance of two marks of a support, and of two arrows of a load (pixels).
const APART: [f64; 2] = [34.0, 22.0];
/// Marks on one line at most.
const MOST_MARKS: usize = 60;
/// Length of the longest arrow, and of that of a resultant (pixels).
const ARROWS: [f64; 2] = [30.0, 44.0];
/// Of rigid tools as much is shown around the bodies as this share of them.
const TOOLS: f64 = 0.4;
/// Height of a line of remarks (pixels).
const REMARK: i32 = 17;
/// Of more things of one kind some are named only, spread over all of them: a figure has room for some 60 names. Lines, marks and
/// arrows are smaller there, by this factor.
const MOST_NAMES: usize = 60;
const FEW_NAMES: usize = 6;
const SMALLER: f64 = 0.3;
/// Fillings of bodies.
const FILLS: [&str; 6] = ["#d9e6f2", "#f8e3d0", "#dcefe7", "#f3e2ee", "#faf0cd", "#e2e6ea"];

/// A body, or a part of one.
#[derive(Clone, Debug, Default)]
pub struct DrawnPart {
    /// What it is called; rigid tools are drawn in grey.
    pub name: String,
    /// Whether it is a rigid tool.
    pub is_rigid: bool,
    /// Its triangles: points around each, counter-clockwise.
    pub triangles: Vec<Vec<[f64; 2]>>,
    /// A point well inside it.
    pub inside: [f64; 2],
}

/// A point of a boundary and the outward normal there.
#[derive(Clone, Copy, Debug)]
pub struct BoundaryPoint {
    /// Where.
    pub place: [f64; 2],
    /// Outward unit normal.
    pub normal: [f64; 2],
    /// What acts there: a traction, or nothing.
    pub traction: [f64; 2],
}

/// Pieces of a boundary, each a row of points.
pub type Rows = Vec<Vec<BoundaryPoint>>;

/// What a support holds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Grip {
    /// Both components.
    Both,
    /// The one along this direction.
    Along([f64; 2]),
    /// The normal one.
    Normal,
    /// Springs.
    Springs,
}

/// A support.
#[derive(Clone, Debug)]
pub struct DrawnSupport {
    /// Its name and what it prescribes.
    pub name: String,
    /// Where it stands.
    pub rows: Rows,
    /// What it holds.
    pub grip: Grip,
}

/// A load.
#[derive(Clone, Debug)]
pub struct DrawnLoad {
    /// Its name.
    pub name: String,
    /// Where it acts, with tractions there.
    pub rows: Rows,
    /// A resultant instead, of a stiff plate, a point or a body: where, and its direction.
    pub resultant: Option<([f64; 2], [f64; 2])>,
    /// Whether a stiff plate carries it.
    pub is_plate: bool,
}

/// Something with a name along a boundary.
#[derive(Clone, Debug)]
pub struct NamedRows {
    /// Its name.
    pub name: String,
    /// Where it is.
    pub rows: Rows,
    /// Where its name belongs; nothing if anywhere along it.
    pub place: Option<BoundaryPoint>,
}

/// What is drawn of a scene.
#[derive(Clone, Debug, Default)]
pub struct SceneFigure {
    /// Stands above.
    pub title: String,
    /// Bodies, or their parts.
    pub parts: Vec<DrawnPart>,
    /// Edges of the macro mesh, each a row of points.
    pub edges: Vec<Vec<[f64; 2]>>,
    /// Named boundaries.
    pub boundaries: Vec<NamedRows>,
    /// Contacts, on both bodies.
    pub contacts: Vec<NamedRows>,
    /// Supports.
    pub supports: Vec<DrawnSupport>,
    /// Loads.
    pub loads: Vec<DrawnLoad>,
    /// What is wrong with the case.
    pub remarks: Vec<String>,
}

impl SceneFigure {
    /// The text of an SVG file.
    ///
    /// # Errors
    /// Words if there is nothing to draw.
    pub fn svg(&self) -> Result<String, String> {
        let (sheet, x, y) = self.sheet().ok_or("there is no triangle with finite corners")?;
        sheet.text(|sheet, area| self.draw(sheet, area, &x, &y)).map_err(|error| error.to_string())
    }

    /// The sheet, and the axes, which show the bodies without distortion.
    fn sheet(&self) -> Option<(Sheet, AxisSpec, AxisSpec)> {
        let around = |parts: &mut dyn Iterator<Item = &DrawnPart>| {
            let points = parts.flat_map(|part| &part.triangles).flatten();
            points.fold([[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]], |[low, high], x| {
                [[low[0].min(x[0]), low[1].min(x[1])], [high[0].max(x[0]), high[1].max(x[1])]]
            })
        };
        let [mut low, mut high] = around(&mut self.parts.iter().filter(|part| !part.is_rigid));
        let [least, most] = around(&mut self.parts.iter());
        // Of a tool that is much larger than the bodies only the part beside them.
        let near = TOOLS * (high[0] - low[0]).max(high[1] - low[1]);
        for axis in [0, 1] {
            (low[axis], high[axis]) = (least[axis].max(low[axis] - near), most[axis].min(high[axis] + near));
        }
        let size = [high[0] - low[0], high[1] - low[1]];
        if !size.iter().all(|size| size.is_finite() && *size > 0.0) {
            return None;
        }
        let inner = ROOM.map(|room| room - 2.0 * AROUND);
        let scale = (inner[0] / size[0]).min(inner[1] / size[1]);
        let pixels = [0, 1].map(|axis| (size[axis] * scale + 2.0 * AROUND).max(LEAST[axis]).round());
        let axis_spec = |axis: usize, name: &str| {
            let (middle, half) = (0.5 * (low[axis] + high[axis]), 0.5 * pixels[axis] / scale);
            let range = [middle - half, middle + half];
            let ticks = Ticks::new(range, (pixels[axis] / 80.0).ceil() as usize);
            AxisSpec { scale: Scale::Linear, name: format!("{name} [{}]", ticks.unit("length")), range, ticks }
        };
        let remarks = REMARK * self.remarks.len() as i32;
        let margins = [66, 18, 62, 54 + remarks];
        let [width, height] = pixels.map(|pixels| pixels as i32);
        let sheet = Sheet { width: width + margins[0] + margins[1], height: height + margins[2] + margins[3], margins };
        Some((sheet, axis_spec(0, "x"), axis_spec(1, "y")))
    }

    fn draw(&self, sheet: &Sheet, area: &super::sheet::Area, x: &AxisSpec, y: &AxisSpec) -> DrawResult<String> {
        sheet.draw_title(area, &self.title)?;
        let [contact, support, load] = [line(&BLUE, 4.0), line(&GREEN, 2.0), line(&VERMILION, 2.0)];
        sheet.draw_legend(area, &[("contact", &[contact]), ("support", &[support]), ("load", &[load])])?;
        // Remarks stand below the axes.
        let remarks = REMARK * self.remarks.len() as i32;
        let (upper, _) = area.split_vertically((sheet.height - remarks) * PIXEL);
        let [left, right, top, bottom] = sheet.margins;
        let axes = Sheet { height: sheet.height - remarks, width: sheet.width, margins: [left, right, top, bottom - remarks] };
        let chart = axes.draw_axes(&upper, x, y, false)?;
        let place = |x: [f64; 2]| chart.backend_coord(&x.into());
        let mut canvas = Canvas::new(sheet, self, &place);
        canvas.text = format!(
            "<clipPath id=\"plot\"><rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"/></clipPath>\n<g clip-path=\"url(#plot)\">\n",
            left * PIXEL,
            top * PIXEL,
            (sheet.width - left - right) * PIXEL,
            (sheet.height - top - bottom) * PIXEL
        );
        canvas.bodies(self);
        canvas.contacts(self);
        canvas.text += "</g>\n";
        canvas.supports(self);
        canvas.loads(self);
        canvas.names(self);
        canvas.remarks(sheet, self);
        canvas.counts(sheet);
        Ok(canvas.text)
    }
}

/// A colour as SVG has it.
fn hex(RGBColor(r, g, b): RGBColor) -> String {
    format!("#{r:02x}{g:02x}{b:02x}")
}

/// Colour of a contact.
fn contact_colour(number: usize) -> RGBColor {
    const COLOURS: [usize; 4] = [0, 4, 3, 5];
    LINES[COLOURS[number % COLOURS.len()]]
}

/// A name, its colour, what it names, and where it would rather stand from there (pixels).
type WantedName = (String, RGBColor, [f64; 2], Option<[f64; 2]>);

/// What has been drawn so far.
struct Canvas<'a> {
    text: String,
    place: &'a dyn Fn([f64; 2]) -> (i32, i32),
    labels: PlacedNames,
    /// Names that are put last, over everything.
    late: String,
    /// Of each kind of which not all could be named: how many are, of how many.
    counts: Vec<String>,
}

impl<'a> Canvas<'a> {
    fn new(sheet: &Sheet, figure: &SceneFigure, place: &'a dyn Fn([f64; 2]) -> (i32, i32)) -> Self {
        let [left, right, top, bottom] = sheet.margins.map(f64::from);
        let room = Frame([left + 3.0, top + 3.0, f64::from(sheet.width) - right - 3.0, f64::from(sheet.height) - bottom - 3.0]);
        let points = figure.boundaries.iter().flat_map(|named| named.rows.iter().flatten());
        let lines = points.map(|point| pixels(place, point.place)).collect();
        Self { text: String::new(), place, labels: PlacedNames::new(room, lines), late: String::new(), counts: Vec::new() }
    }

    fn at(&self, x: [f64; 2]) -> [f64; 2] {
        pixels(self.place, x)
    }

    fn bodies(&mut self, figure: &SceneFigure) {
        let outline = |part: &DrawnPart| {
            let around = |points: &Vec<[f64; 2]>| {
                let placed: Vec<(i32, i32)> = points.iter().map(|x| (self.place)(*x)).collect();
                (0..placed.len()).map(|k| [placed[k], placed[(k + 1) % placed.len()]]).collect::<Vec<_>>()
            };
            path_data(&loops(&unmatched(part.triangles.iter().flat_map(around))))
        };
        let outlines: Vec<String> = figure.parts.iter().map(outline).collect();
        for (number, (part, data)) in figure.parts.iter().zip(&outlines).enumerate() {
            let fill = if part.is_rigid { "#b4b4b4" } else { FILLS[number % FILLS.len()] };
            let _ = writeln!(self.text, "<path fill=\"{fill}\" fill-rule=\"evenodd\" d=\"{data}\"/>");
        }
        let placed = |row: &Vec<[f64; 2]>| line_data(&row.iter().map(|x| (self.place)(*x)).collect::<Vec<_>>());
        let lines: String = figure.edges.iter().map(placed).collect();
        if !lines.is_empty() {
            let _ = writeln!(self.text, "<path fill=\"none\" stroke=\"#fff\" stroke-width=\"6\" d=\"{lines}\"/>");
        }
        for data in outlines {
            let _ = writeln!(self.text, "<path fill=\"none\" stroke=\"{}\" stroke-width=\"10\" d=\"{data}\"/>", hex(INK));
        }
    }

    /// Lines along the rows.
    fn along(&mut self, rows: &Rows, colour: &str, width: f64, opacity: f64) {
        let placed = |row: &Vec<BoundaryPoint>| line_data(&row.iter().map(|point| (self.place)(point.place)).collect::<Vec<_>>());
        let lines: String = rows.iter().map(placed).collect();
        let width = width * f64::from(PIXEL);
        let _ = writeln!(
            self.text,
            "<path fill=\"none\" stroke=\"{colour}\" stroke-opacity=\"{opacity}\" stroke-width=\"{width:.0}\" d=\"{lines}\"/>"
        );
    }

    fn contacts(&mut self, figure: &SceneFigure) {
        for (number, contact) in figure.contacts.iter().enumerate() {
            self.along(&contact.rows, &hex(contact_colour(number)), 4.0 * size_of_marks(figure.contacts.len()), 0.85);
        }
    }

    fn supports(&mut self, figure: &SceneFigure) {
        let colour = hex(GREEN);
        let size = size_of_marks(figure.supports.len());
        for support in &figure.supports {
            self.along(&support.rows, &colour, 2.0 * size, 1.0);
            for point in self.spread(&support.rows, APART[0]) {
                let normal = flipped(point.normal);
                let direction = match support.grip {
                    Grip::Along(axis) => {
                        let axis = flipped(axis);
                        if axis[0] * normal[0] + axis[1] * normal[1] < 0.0 { axis.map(|part| -part) } else { axis }
                    }
                    _ => normal,
                };
                let at = self.at(point.place);
                self.mark(at, direction, support.grip, &colour, size);
            }
        }
    }

    /// Points of rows, about so many pixels apart.
    fn spread(&self, rows: &Rows, apart: f64) -> Vec<BoundaryPoint> {
        let mut found = Vec::new();
        for row in rows {
            let placed: Vec<[f64; 2]> = row.iter().map(|point| self.at(point.place)).collect();
            let steps: Vec<f64> = placed.windows(2).map(|two| (two[1][0] - two[0][0]).hypot(two[1][1] - two[0][1])).collect();
            let length: f64 = steps.iter().sum();
            let count = ((length / apart).round() as usize).clamp(1, MOST_MARKS);
            let (mut passed, mut next) = (0.0, 0);
            for (k, step) in steps.iter().enumerate() {
                while next < count && (next as f64 + 0.5) * length / count as f64 <= passed + step {
                    let share = ((next as f64 + 0.5) * length / count as f64 - passed) / step.max(f64::MIN_POSITIVE);
                    let (a, b) = (row[k], row[k + 1]);
                    let between = |a: [f64; 2], b: [f64; 2]| [0, 1].map(|axis| a[axis] + share * (b[axis] - a[axis]));
                    found.push(BoundaryPoint {
                        place: between(a.place, b.place),
                        normal: between(a.normal, b.normal),
                        traction: between(a.traction, b.traction),
                    });
                    next += 1;
                }
                passed += step;
            }
            if row.len() == 1 {
                found.push(row[0]);
            }
        }
        found
    }

    /// A triangle with its tip at the boundary: on a hatched ground, on rollers, or a spring.
    fn mark(&mut self, at: [f64; 2], out: [f64; 2], grip: Grip, colour: &str, size: f64) {
        let p = f64::from(PIXEL);
        let point = |away: f64, aside: f64| {
            let [away, aside] = [size * away, size * aside];
            let [x, y] = [at[0] + away * out[0] - aside * out[1], at[1] + away * out[1] + aside * out[0]];
            format!("{:.0} {:.0}", p * x, p * y)
        };
        let width = 10.0 * size;
        let thin = format!("fill=\"none\" stroke=\"{colour}\" stroke-width=\"{width:.0}\"");
        if grip == Grip::Springs {
            let turns: String =
                (1..7).map(|k| format!("L{}", point(2.0 + 1.8 * f64::from(k), if k % 2 == 0 { 3.5 } else { -3.5 }))).collect();
            let _ = writeln!(
                self.text,
                "<path {thin} d=\"M{}L{}{turns}L{}L{}M{}L{}\"/>",
                point(0.0, 0.0),
                point(2.0, 0.0),
                point(14.6, 0.0),
                point(17.0, 0.0),
                point(17.0, -6.0),
                point(17.0, 6.0)
            );
        } else {
            let _ = writeln!(
                self.text,
                "<path fill=\"#fff\" stroke=\"{colour}\" stroke-width=\"{width:.0}\" d=\"M{}L{}L{}z\"/>",
                point(0.5, 0.0),
                point(9.5, -5.5),
                point(9.5, 5.5)
            );
            if grip == Grip::Both {
                let hatch: String = (-2..=2)
                    .map(|k| format!("M{}L{}", point(9.5, 3.5 * f64::from(k) + 1.0), point(13.5, 3.5 * f64::from(k) - 2.0)))
                    .collect();
                let _ = writeln!(self.text, "<path {thin} d=\"M{}L{}{hatch}\"/>", point(9.5, -8.0), point(9.5, 8.0));
            } else {
                for aside in [-3.0, 3.0] {
                    let centre = point(11.8, aside);
                    let (x, y) = centre.split_once(' ').unwrap_or(("0", "0"));
                    let _ = writeln!(self.text, "<circle cx=\"{x}\" cy=\"{y}\" r=\"{:.0}\" {thin}/>", 20.0 * size);
                }
                let _ = writeln!(self.text, "<path {thin} d=\"M{}L{}\"/>", point(14.5, -8.0), point(14.5, 8.0));
            }
        }
        self.labels.take([at[0] + 8.0 * size * out[0], at[1] + 8.0 * size * out[1]], 15.0 * size);
    }

    fn loads(&mut self, figure: &SceneFigure) {
        let colour = hex(VERMILION);
        let size = |point: &BoundaryPoint| point.traction[0].hypot(point.traction[1]);
        let smaller = size_of_marks(figure.loads.len());
        let longest = ARROWS.map(|length| smaller * length);
        for load in &figure.loads {
            if load.is_plate {
                self.along(&load.rows, &colour, 4.5, 0.9);
            } else if !load.rows.is_empty() {
                self.along(&load.rows, &colour, 2.0, 1.0);
            }
            if let Some((place, direction)) = load.resultant {
                let length = direction[0].hypot(direction[1]);
                let normal = load.rows.iter().flatten().next().map_or(direction.map(|part| -part), |point| point.normal);
                if length > 0.0 {
                    let direction = direction.map(|part| part / length);
                    let at = self.labels.within(self.at(place), longest[1]);
                    self.arrow(at, flipped(direction), flipped(normal), longest[1], &colour, 18.0 * smaller);
                }
                continue;
            }
            let largest = load.rows.iter().flatten().map(size).fold(0.0, f64::max);
            for point in self.spread(&load.rows, APART[1]) {
                let size = size(&point);
                if size > 1e-6 * largest && largest.is_finite() {
                    let direction = point.traction.map(|part| part / size);
                    let length = (longest[0] * size / largest).max(8.0 * smaller);
                    self.arrow(self.at(point.place), flipped(direction), flipped(point.normal), length, &colour, 10.0 * smaller);
                }
            }
        }
    }

    /// An arrow outside the body: it ends at the point if it pushes, and begins there if it pulls.
    fn arrow(&mut self, at: [f64; 2], along: [f64; 2], normal: [f64; 2], length: f64, colour: &str, width: f64) {
        let pushes = along[0] * normal[0] + along[1] * normal[1] <= 0.0;
        let shift = |from: [f64; 2], by: f64, aside: f64| {
            [from[0] + by * along[0] - aside * along[1], from[1] + by * along[1] + aside * along[0]]
        };
        let tip = if pushes { shift(at, -1.0, 0.0) } else { shift(at, length, 0.0) };
        let head = (5.0 + 0.2 * width).min(0.5 * length);
        let p = f64::from(PIXEL);
        let text = |[x, y]: [f64; 2]| format!("{:.0} {:.0}", p * x, p * y);
        let _ = writeln!(
            self.text,
            "<path fill=\"none\" stroke=\"{colour}\" stroke-width=\"{width:.0}\" d=\"M{}L{}\"/><path fill=\"{colour}\" d=\"M{}L{}L{}z\"/>",
            text(shift(tip, -length, 0.0)),
            text(shift(tip, -head, 0.0)),
            text(tip),
            text(shift(tip, -head, 0.42 * head)),
            text(shift(tip, -head, -0.42 * head))
        );
        for share in [0.2, 0.5, 0.8] {
            self.labels.take(shift(tip, -share * length, 0.0), 9.0);
        }
    }

    /// Names: of bodies first, then of what was asked for, then of all boundaries.
    fn names(&mut self, figure: &SceneFigure) {
        let of_part = |part: &DrawnPart, own: &Self| Some((part.name.clone(), INK, own.at(part.inside), None));
        self.named(&figure.parts, "bodies", 14.0, of_part);
        let numbers: Vec<usize> = (0..figure.contacts.len()).collect();
        let of_contact = |&number: &usize, own: &Self| {
            let contact = &figure.contacts[number];
            let place = contact.place.map(|point| (own.at(point.place), flipped(point.normal)));
            let (anchor, [x, y]) = place.or_else(|| own.middle(&contact.rows, 0.5))?;
            Some((format!("contact {}", contact.name), contact_colour(number), anchor, Some([-x, -y])))
        };
        self.named(&numbers, "contacts", 12.0, of_contact);
        let of_support = |support: &DrawnSupport, own: &Self| {
            let (anchor, towards) = own.middle(&support.rows, 0.5)?;
            Some((support.name.clone(), GREEN, anchor, Some(towards)))
        };
        self.named(&figure.supports, "supports", 11.0, of_support);
        let of_load = |load: &DrawnLoad, own: &Self| {
            let resultant = || load.resultant.map(|(place, _)| (own.labels.within(own.at(place), ARROWS[1]), [1.0, 0.0]));
            let (anchor, towards) = own.middle(&load.rows, 0.5).or_else(resultant)?;
            Some((load.name.clone(), VERMILION, anchor, Some(towards)))
        };
        self.named(&figure.loads, "loads", 11.0, of_load);
        let size = 18.0 * size_of_marks(figure.boundaries.len());
        for row in figure.boundaries.iter().flat_map(|boundary| &boundary.rows) {
            for end in [row.first(), row.last()].into_iter().flatten() {
                let [x, y] = self.at(end.place).map(|x| f64::from(PIXEL) * x);
                let _ = writeln!(self.text, "<circle cx=\"{x:.0}\" cy=\"{y:.0}\" r=\"{size:.0}\" fill=\"{}\"/>", hex(INK));
            }
        }
        let of_boundary = |boundary: &NamedRows, own: &Self| {
            let (anchor, towards) = own.middle(&boundary.rows, 0.3)?;
            Some((boundary.name.clone(), GREY, anchor, Some(towards)))
        };
        self.named(&figure.boundaries, "boundaries", 11.0, of_boundary);
        let late = std::mem::take(&mut self.late);
        self.text += &late;
    }

    /// Names of one kind, as far as there is room: text, colour, what is named, and where the name would rather stand from there.
    fn named<T>(&mut self, all: &[T], kind: &str, size: f64, of: impl Fn(&T, &Self) -> Option<WantedName>) {
        let every = if all.len() > MOST_NAMES { all.len().div_ceil(FEW_NAMES) } else { 1 };
        let weight = if size > 11.0 { "bold" } else { "normal" };
        let mut count = 0;
        for one in all.iter().step_by(every) {
            let Some((text, colour, anchor, towards)) = of(one, self) else { continue };
            let text: String = if text.chars().count() > 40 { text.chars().take(39).chain(['…']).collect() } else { text };
            let put = self.labels.put(&Name { text: &text, size, colour: &hex(colour), weight, anchor, towards });
            count += usize::from(put.is_some());
            self.late += &put.unwrap_or_default();
        }
        if count < all.len() {
            self.counts.push(format!("{count} of {} {kind}", all.len()));
        }
    }

    /// Of how many things some are named only, between legend and plot.
    fn counts(&mut self, sheet: &Sheet) {
        if !self.counts.is_empty() {
            let [x, y] = [sheet.width - 12, 57].map(|pixels| pixels * PIXEL);
            let words = self.counts.join(", ");
            let _ = writeln!(
                self.text,
                "<text x=\"{x}\" y=\"{y}\" text-anchor=\"end\" font-family=\"sans-serif\" font-size=\"100\" fill=\"{}\">named: {words}</text>",
                hex(GREY)
            );
        }
    }

    /// A place at this share of the longest row, and the direction out of the body there, in the figure.
    fn middle(&self, rows: &Rows, share: f64) -> Option<([f64; 2], [f64; 2])> {
        let row = rows.iter().max_by_key(|row| row.len())?;
        let point = row.get(((row.len() - 1) as f64 * share).round() as usize)?;
        Some((self.at(point.place), flipped(point.normal)))
    }

    fn remarks(&mut self, sheet: &Sheet, figure: &SceneFigure) {
        let first = sheet.height - REMARK * figure.remarks.len() as i32;
        for (k, remark) in figure.remarks.iter().enumerate() {
            let y = (first + REMARK * k as i32 + 8) * PIXEL;
            let _ = writeln!(
                self.text,
                "<text x=\"{}\" y=\"{y}\" font-family=\"sans-serif\" font-size=\"120\" fill=\"{}\">{}</text>",
                12 * PIXEL,
                hex(VERMILION),
                escaped(remark)
            );
        }
    }
}

/// How large marks are drawn of which there are so many.
fn size_of_marks(count: usize) -> f64 {
    if count > MOST_NAMES { SMALLER } else { 1.0 }
}

/// A place in pixels.
fn pixels(place: &dyn Fn([f64; 2]) -> (i32, i32), x: [f64; 2]) -> [f64; 2] {
    let (x, y) = place(x);
    [x, y].map(|x| f64::from(x) / f64::from(PIXEL))
}

/// A direction of the plane in the figure, whose y axis goes down.
fn flipped([x, y]: [f64; 2]) -> [f64; 2] {
    [x, -y]
}
