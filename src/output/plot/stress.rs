//! Von Mises stress in steps of colour: on the bodies, and as a bar beside them.

use plotters::element::{PathElement, Rectangle, Text};
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{Color, FontStyle, FontTransform, RGBColor};

use super::facets::Facet;
use super::outline::{edges_around, loops, path_data, unmatched};
use super::palette::{GREY, INK, hex, viridis};
use super::sheet::{Area, DrawResult, PIXEL, Sheet, line, text_style};
use super::ticks::{Ticks, cut_off, number_text};

/// Steps of the colour bar.
const LEVELS: usize = 40;
/// Room for the colour bar beside the plot (pixels).
pub(super) const BAR_ROOM: i32 = 120;

/// Von Mises stress from zero to `top` in equal steps of colour; peaks above take the last one.
pub(super) struct Colours {
    top: f64,
    peak: Option<f64>,
}

impl Colours {
    pub fn of(facets: &[Facet]) -> Colours {
        let area = |[a, b, c]: [[f64; 2]; 3]| ((b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1])).abs();
        let weighted: Vec<(f64, f64)> =
            facets.iter().map(|facet| (facet.von_mises.iter().sum::<f64>() / 3.0, area(facet.corners))).collect();
        let high = facets.iter().flat_map(|facet| facet.von_mises).fold(0.0, f64::max);
        match cut_off(high, weighted) {
            Some(top) => Colours { top, peak: Some(high) },
            None => Colours { top: if high > 0.0 { high } else { 1.0 }, peak: None },
        }
    }

    /// Corner values of a facet in steps of colour: level k reaches from k to k + 1.
    fn steps(&self, facet: &Facet) -> [f64; 3] {
        facet.von_mises.map(|value| value / self.top * LEVELS as f64)
    }

    fn level(step: f64) -> usize {
        (step as usize).min(LEVELS - 1)
    }

    fn colour(level: usize) -> RGBColor {
        viridis(level as f64 / (LEVELS - 1) as f64)
    }
}

/// The triangles cut into bands of colour, merged where neighbours have the same. A line of that colour closes the hairlines
/// between merged areas.
pub(super) fn fills(facets: &[Facet], scale: f64, colours: &Colours, place: impl Fn([f64; 2]) -> (i32, i32)) -> String {
    let mut edges = vec![Vec::new(); LEVELS];
    for facet in facets {
        let (corners, steps) = (facet.deformed(scale), colours.steps(facet));
        let [low, high] = [steps.iter().copied().fold(f64::INFINITY, f64::min), steps.iter().copied().fold(0.0, f64::max)];
        let [first, last] = [low, high].map(Colours::level);
        for (level, edges) in edges.iter_mut().enumerate().take(last + 1).skip(first) {
            let upper = if level + 1 < LEVELS { level as f64 + 1.0 } else { f64::INFINITY };
            let polygon: Vec<(i32, i32)> = band(&corners, &steps, [level as f64, upper]).into_iter().map(&place).collect();
            edges.extend(edges_around(&polygon));
        }
    }
    let path = |(level, edges): (usize, Vec<_>)| {
        let (colour, data) = (hex(Colours::colour(level)), path_data(&loops(&unmatched(edges))));
        format!("<path fill=\"{colour}\" stroke=\"{colour}\" stroke-width=\"4\" d=\"{data}\"/>\n")
    };
    edges.into_iter().enumerate().filter(|(_, edges)| !edges.is_empty()).map(path).collect()
}

/// The part of a triangle where a value, linear between its corners, lies in a range. Neighbours with the same corner values cut
/// their common edge at the same points.
fn band(corners: &[[f64; 2]; 3], values: &[f64; 3], [low, high]: [f64; 2]) -> Vec<[f64; 2]> {
    let mut points = Vec::with_capacity(5);
    for (from, to) in [(0, 1), (1, 2), (2, 0)] {
        if low <= values[from] && values[from] <= high {
            points.push(corners[from]);
        }
        let rises = values[from] < values[to];
        let [below, above] = if rises { [from, to] } else { [to, from] };
        for limit in if rises { [low, high] } else { [high, low] } {
            if values[below] < limit && limit < values[above] {
                let fraction = (limit - values[below]) / (values[above] - values[below]);
                points.push([0, 1].map(|k| (1.0 - fraction) * corners[below][k] + fraction * corners[above][k]));
            }
        }
    }
    points
}

/// Draws the bar of colours at the right of the plot, with its ticks and its name.
pub(super) fn draw_colour_bar(sheet: &Sheet, area: &Area, colours: &Colours) -> DrawResult<()> {
    let left = (sheet.width - BAR_ROOM + 24) * PIXEL;
    let right = left + 16 * PIXEL;
    let [top, bottom] = [sheet.margins[2], sheet.height - sheet.margins[3]].map(|y| y * PIXEL);
    let height_of = |fraction: f64| bottom - (f64::from(bottom - top) * fraction).round() as i32;
    for level in 0..LEVELS {
        let low = height_of(level as f64 / LEVELS as f64); // up to the top: the next ones lie on it, without hairlines between
        area.draw(&Rectangle::new([(left, top), (right, low)], Colours::colour(level).filled()))?;
    }
    area.draw(&Rectangle::new([(left, top), (right, bottom)], line(&GREY, 0.8)))?;
    let ticks = Ticks::new([0.0, colours.top], 5);
    let label = text_style(11.0, FontStyle::Normal, INK).pos(Pos::new(HPos::Left, VPos::Center));
    for &value in &ticks.values {
        let y = height_of(value / colours.top);
        area.draw(&PathElement::new(vec![(right, y), (right + 4 * PIXEL, y)], line(&GREY, 0.8)))?;
        area.draw(&Text::new(ticks.label(value), (right + 7 * PIXEL, y), label.clone()))?;
    }
    let name = format!("von Mises stress [{}]", ticks.unit("stress"));
    let upright = text_style(12.0, FontStyle::Normal, INK).transform(FontTransform::Rotate270);
    let upright = upright.pos(Pos::new(HPos::Center, VPos::Bottom));
    area.draw(&Text::new(name, (right + 62 * PIXEL, (top + bottom) / 2), upright))?;
    match colours.peak {
        Some(peak) => sheet.draw_remark(area, &format!("stress up to {}", number_text(peak))),
        None => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bands_of_colour_make_up_the_triangle() {
        let corners = [[0.0, 0.0], [4.0, 0.0], [1.0, 3.0]];
        let area = |points: Vec<[f64; 2]>| {
            let cross = |[a, b]: [[f64; 2]; 2]| 0.5 * (a[0] * b[1] - a[1] * b[0]);
            (0..points.len()).map(|k| cross([points[k], points[(k + 1) % points.len()]])).sum::<f64>()
        };
        for values in [[0.2, 3.7, 1.4], [2.0, 2.0, 0.0], [1.0, 1.5, 1.0], [2.5; 3]] {
            let sum: f64 = (0..4).map(|level| area(band(&corners, &values, [level as f64, level as f64 + 1.0]))).sum();
            assert!((sum - 6.0).abs() < 1e-14, "{values:?}: {sum}");
        }
        assert_eq!(band(&corners, &[0.0, 4.0, 4.0], [1.0, 2.0]).len(), 4);
    }
}
