"""A sheet of small plots, written as SVG."""

import math
from xml.sax.saxutils import escape

INK, GREY, GRID = "#262626", "#6e6e6e", "#e4e4e4"
BLUE, VERMILION, GREEN = "#0072b2", "#d55e00", "#009e73"      # Okabe and Ito: all eyes can tell them apart


class Axis:
    """A range, linear or logarithmic, with its ticks."""

    def __init__(self, low, high, ticks, log=False):
        self.map = math.log10 if log else float
        self.low, self.high, self.ticks = self.map(low), self.map(high), ticks

    def fraction(self, value):
        """Where a value lies between both ends; values beyond an end come to lie a little outside."""
        if value is None or not math.isfinite(value) or (self.map is math.log10 and value <= 0):
            return None
        return min(max((self.map(value) - self.low) / (self.high - self.low), -0.05), 1.05)

    def label(self, value):
        if self.map is math.log10 and value < 1:
            return f"1e{round(math.log10(value))}"
        return f"{value:g}"


class Sheet:
    """Plots in rows and columns under a title and a legend."""

    LEFT, TOP, RIGHT, BOTTOM, GAP = 64, 74, 14, 44, 12

    def __init__(self, title, columns, rows, width=216, height=150):
        self.columns, self.rows, self.width, self.height = columns, rows, width, height
        self.parts = []
        self.text(self.LEFT, 20, title, "start", 14, "bold")

    def text(self, x, y, words, anchor="middle", size=11, weight="normal", turn=0):
        turned = f' transform="rotate({turn} {x:g} {y:g})"' if turn else ""
        style = f'text-anchor="{anchor}" font-size="{size}" font-weight="{weight}" fill="{INK}"'
        self.parts.append(f'<text x="{x:g}" y="{y:g}" {style}{turned}>{escape(words)}</text>')

    def line(self, points, colour, width=1.0, dash="", clip=""):
        path = " ".join(f"{x:.1f},{y:.1f}" for x, y in points)
        style = (f' stroke-dasharray="{dash}"' if dash else "") + (f' clip-path="url(#{clip})"' if clip else "")
        self.parts.append(f'<polyline fill="none" stroke="{colour}" stroke-width="{width:g}"{style} points="{path}"/>')

    def dot(self, x, y, colour, radius=2.2, hollow=False):
        fill = "#fff" if hollow else colour
        self.parts.append(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="{radius:g}" fill="{fill}" stroke="{colour}"/>')

    def legend(self, entries):
        """Words beside a piece of each line: (words, colour, width, dash), or a dot where the width is 0."""
        x = self.LEFT
        for words, colour, width, dash in entries:
            if width:
                self.line([(x, 38), (x + 26, 38)], colour, width, dash)
            else:
                self.dot(x + 13, 38, colour, hollow=dash == "hollow")
            self.text(x + 32, 42, words, "start")
            x += 50 + 6.2 * len(words)

    def plot(self, column, row, x_axis, y_axis):
        return Plot(self, column, row, x_axis, y_axis)

    def write(self, path):
        wide = self.LEFT + self.columns * (self.width + self.GAP) - self.GAP + self.RIGHT
        high = self.TOP + self.rows * (self.height + self.GAP) - self.GAP + self.BOTTOM
        head = f'<svg xmlns="http://www.w3.org/2000/svg" width="{wide}" height="{high}" viewBox="0 0 {wide} {high}"'
        body = ['<rect width="100%" height="100%" fill="#fff"/>', *self.parts]
        path.write_text("\n".join([head + ' font-family="sans-serif" stroke-linejoin="round">', *body, "</svg>", ""]))


class Plot:
    """One plot of a sheet. Axes are labelled along the left and the lower edge of the sheet only."""

    def __init__(self, sheet, column, row, x_axis, y_axis):
        self.sheet, self.x_axis, self.y_axis = sheet, x_axis, y_axis
        self.x = sheet.LEFT + column * (sheet.width + sheet.GAP)
        self.y = sheet.TOP + row * (sheet.height + sheet.GAP)
        self.clip = f"plot{column}_{row}"
        box = f'x="{self.x}" y="{self.y}" width="{sheet.width}" height="{sheet.height}"'
        sheet.parts.append(f'<clipPath id="{self.clip}"><rect {box}/></clipPath>')
        right, below = self.x + sheet.width, self.y + sheet.height
        for value in x_axis.ticks:
            at = self.across(value)
            sheet.line([(at, self.y), (at, below)], GRID)
            if row == sheet.rows - 1:
                sheet.text(at, below + 15, x_axis.label(value))
        for value in y_axis.ticks:
            at = self.up(value)
            sheet.line([(self.x, at), (right, at)], GRID)
            if column == 0:
                sheet.text(self.x - 6, at + 4, y_axis.label(value), "end")
        sheet.parts.append(f'<rect {box} fill="none" stroke="{GREY}"/>')

    def across(self, value):
        return self.x + self.x_axis.fraction(value) * self.sheet.width

    def up(self, value):
        return self.y + (1.0 - self.y_axis.fraction(value)) * self.sheet.height

    def place(self, x, y):
        """Where a point lies on the sheet, if it has a value."""
        return None if self.y_axis.fraction(y) is None else (self.across(x), self.up(y))

    def curve(self, xs, ys, colour, width=1.0, dash=""):
        """A line through all points that have a value; it breaks where one has none."""
        run = []
        for point in [*(self.place(x, y) for x, y in zip(xs, ys)), None]:
            if point is not None:
                run.append(point)
            elif run:
                self.sheet.line(run, colour, width, dash, self.clip)
                run = []

    def dots(self, xs, ys, colour, hollow=None):
        """Dots inside the plot; `hollow` says which."""
        for at, point in enumerate(self.place(x, y) for x, y in zip(xs, ys)):
            if point is not None and self.y <= point[1] <= self.y + self.sheet.height:
                self.sheet.dot(*point, colour, hollow=bool(hollow and hollow[at]))

    def head(self, words):
        """Words above the plot."""
        self.sheet.text(self.x + 0.5 * self.sheet.width, self.y - 7, words)

    def side(self, words):
        """Words left of the plot's ticks."""
        self.sheet.text(self.x - 50, self.y + 0.5 * self.sheet.height, words, turn=-90)

    def note(self, words):
        """Words in the upper left corner of the plot."""
        self.sheet.text(self.x + 6, self.y + 15, words, "start")

    def foot(self, words):
        """Words under the ticks."""
        self.sheet.text(self.x + 0.5 * self.sheet.width, self.y + self.sheet.height + 32, words)
