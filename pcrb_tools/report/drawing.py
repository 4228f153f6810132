"""Numbers as people read them, axes, and drawings: one drawing makes the page's SVG and the figures of figures.py.

A drawing is a list of marks in units of which a page's column has 440, y downwards. Every number can be read from a mark's title
(`<title>`, which the page's script also shows on a tap).
"""
import math
from html import escape

WIDTH = 440
LEFT, RIGHT, TOP, BOTTOM = 64, 12, 10, 40


def decimals_of(value):
    """Decimals that give a number three significant digits; None if it is too small or large for any."""
    size = abs(float(f'{value:.2e}'))  # 9.999 has become 10
    if size == 0:
        return 0
    return None if size < 1e-4 or size >= 1e5 else max(0, 2 - math.floor(math.log10(size)))


def error(value):
    """Three significant digits, and never 0.000 for what is not 0."""
    if value is None:
        return '–'
    decimals = decimals_of(value)
    return f'{value:.2e}' if decimals is None else f'{value:.{decimals}f}'


def interval(low, high):
    """Both ends with the precision of the upper one."""
    decimals = decimals_of(high)
    if decimals is None or 0 < low < 0.5 * 10 ** -decimals:
        return f'{error(low)} – {error(high)}'
    return f'{low:.{decimals}f} – {high:.{decimals}f}'


def short(value):
    """A tick's label: no zeros that say nothing."""
    return f'{value:.6g}'


def shortened(name, letters):
    """A name where a chart has no room for more: both its ends. Legends, titles and tables have all of it."""
    tail = (letters - 1) // 2
    return name if len(name) <= letters else f'{name[:letters - 1 - tail]}…{name[-tail:]}'


def interval_text(row):
    """The interval of a median as a title has it."""
    return f'95 % interval {interval(row["low"], row["high"])}' if row['low'] is not None else 'too few pairs for an interval'


def coordinate(value):
    return f'{value:.2f}'.rstrip('0').rstrip('.')


class Linear:

    def __init__(self, low, high, whole=False):
        self.low, self.high = low, high if high > low else low + 1
        self.whole = whole  # ticks at whole numbers only

    def __call__(self, value):
        return (min(max(value, self.low), self.high) - self.low) / (self.high - self.low)

    def ticks(self, count=5):
        rough = (self.high - self.low) / count
        power = 10 ** math.floor(math.log10(rough))
        step = next(m * power for m in ((1, 2, 5, 10) if self.whole else (1, 2, 2.5, 5, 10)) if m * power >= rough * 0.999)
        if self.whole:
            step = max(step, 1)
        first = math.ceil(self.low / step - 1e-9)
        last = math.floor(self.high / step + 1e-9)
        return [round(i * step, 12) for i in range(first, last + 1)]


class Logarithmic:
    def __init__(self, low, high):
        self.low, self.high = low, max(high, low * 1.01)

    def __call__(self, value):
        value = min(max(value, self.low), self.high)
        return math.log(value / self.low) / math.log(self.high / self.low)

    def ticks(self, count=5):
        decades = range(math.ceil(math.log10(self.low) - 1e-9), math.floor(math.log10(self.high) + 1e-9) + 1)
        ticks = [10.0 ** d for d in decades]
        if len(ticks) < 3:
            ticks = [m * 10.0 ** d for d in range(decades.start - 1, decades.stop + 1) for m in (1, 2, 5)]
        return [t for t in ticks if self.low * 0.999 <= t <= self.high * 1.001]


class Ink:
    """How a method is drawn: a colour, a shape and a dash, so that no two need colours to be told apart."""

    def __init__(self, color, shape='circle', dash=''):
        self.color, self.shape, self.dash = color, shape, dash


SHAPES = {  # corners about a middle, of a size like that of a circle of radius 1
    'square': [(-.88, -.88), (.88, -.88), (.88, .88), (-.88, .88)],
    'triangle': [(0, -1.2), (1.1, .85), (-1.1, .85)],
    'diamond': [(0, -1.25), (1.25, 0), (0, 1.25), (-1.25, 0)],
    'wedge': [(0, 1.2), (1.1, -.85), (-1.1, -.85)],
    'cross': [(-.4, -1.2), (.4, -1.2), (.4, -.4), (1.2, -.4), (1.2, .4), (.4, .4), (.4, 1.2), (-.4, 1.2), (-.4, .4), (-1.2, .4),
              (-1.2, -.4), (-.4, -.4)],
    'hexagon': [(-.55, -1.05), (.55, -1.05), (1.15, 0), (.55, 1.05), (-.55, 1.05), (-1.15, 0)],
    'bow': [(-1.1, -1), (1.1, 1), (1.1, -1), (-1.1, 1)],
    'bar': [(-.4, -1.3), (.4, -1.3), (.4, 1.3), (-.4, 1.3)],
}


class Drawing:
    """Marks with a class (what they are), perhaps a colour, a title, and the method that they belong to."""

    def __init__(self, height, label='', width=WIDTH):
        self.width, self.height, self.label = width, height, label
        self.marks = []

    def line(self, a, b, kind, color=None, title=None, method=None):
        self.marks.append(('line', [a, b], {'kind': kind, 'color': color, 'title': title, 'method': method}))

    def polyline(self, points, kind, color, title=None, method=None, dash=''):
        self.marks.append(('polyline', list(points), {'kind': kind, 'color': color, 'title': title, 'method': method, 'dash': dash}))

    def polygon(self, points, kind, color, title=None, method=None):
        self.marks.append(('polygon', list(points), {'kind': kind, 'color': color, 'title': title, 'method': method}))

    def circle(self, at, radius, kind, color, title=None, method=None):
        self.marks.append(('circle', [at], {'kind': kind, 'color': color, 'title': title, 'method': method, 'radius': radius}))

    def symbol(self, at, radius, kind, ink, title=None, method=None):
        """A method's mark in its shape."""
        if ink.shape == 'circle':
            self.circle(at, radius, kind, ink.color, title, method)
        else:
            self.polygon([(at[0] + radius * x, at[1] + radius * y) for x, y in SHAPES[ink.shape]], kind, ink.color, title, method)

    def squares(self, points, size, kind):
        """Many small squares, one mark."""
        if points:
            self.marks.append(('squares', list(points), {'kind': kind, 'method': None, 'size': size}))

    def text(self, x, y, text, kind='', anchor='middle', method=None, upright=False):
        self.marks.append(('text', [(x, y)], {'kind': kind, 'text': text, 'anchor': anchor, 'method': method, 'upright': upright}))

    def include(self, other, dx, dy):
        """The marks of another drawing, moved."""
        for name, points, style in other.marks:
            self.marks.append((name, [(x + dx, y + dy) for x, y in points], style))

    def svg(self, kind=''):
        kind = f' class="{kind}"' if kind else ''
        return (f'<svg viewBox="0 0 {self.width} {coordinate(self.height)}" role="img"{kind} aria-label="{escape(self.label, quote=True)}">'
                + ''.join(element(*mark) for mark in self.marks) + '</svg>')


def element(name, points, style):
    """A mark as SVG."""
    text = f' class="{style["kind"]}"'
    if style['method']:
        text += f' data-method="{escape(style["method"], quote=True)}"'
    if style.get('color'):
        text += f' style="{"stroke" if name in ("line", "polyline") else "fill"}:{style["color"]}"'
    if style.get('dash'):
        text += f' stroke-dasharray="{style["dash"]}"'
    title = f'<title>{escape(style["title"])}</title>' if style.get('title') else ''
    flat = [coordinate(value) for point in points for value in point]
    if name == 'line':
        return f'<line x1="{flat[0]}" y1="{flat[1]}" x2="{flat[2]}" y2="{flat[3]}"{text}>{title}</line>'
    if name == 'squares':
        size = coordinate(style['size'])
        return '<path d="' + ''.join(f'M{a} {b}h{size}v{size}h-{size}z' for a, b in zip(flat[::2], flat[1::2])) + f'"{text}/>'
    if name == 'circle':
        return f'<circle cx="{flat[0]}" cy="{flat[1]}" r="{coordinate(style["radius"])}"{text}>{title}</circle>'
    if name == 'text':
        place = f'transform="translate({flat[0]} {flat[1]}) rotate(-90)"' if style['upright'] else f'x="{flat[0]}" y="{flat[1]}"'
        return f'<text {place} text-anchor="{style["anchor"]}"{text}>{escape(style["text"])}</text>'
    where = ' '.join(f'{a},{b}' for a, b in zip(flat[::2], flat[1::2]))
    return f'<{name} points="{where}"{text}>{title}</{name}>'


class Chart(Drawing):
    """A frame with two axes and what is drawn into it."""

    def __init__(self, x, y, x_name, y_name, height=250, label='', left=LEFT, width=WIDTH):
        super().__init__(height, label, width)
        self.x, self.y, self.left = x, y, left
        self.draw_axes(x_name, y_name)

    def at(self, x, y):
        return (self.left + self.x(x) * (self.width - self.left - RIGHT), self.height - BOTTOM - self.y(y) * (self.height - TOP - BOTTOM))

    def draw_axes(self, x_name, y_name):
        bottom = self.height - BOTTOM
        for tick in self.y.ticks(4):
            y = self.at(self.x.low, tick)[1]
            self.line((self.left, y), (self.width - RIGHT, y), 'grid')
            self.text(self.left - 6, y + 4, short(tick), 'tick', 'end')
        free = -math.inf  # from there on a label has room
        for tick in self.x.ticks():
            x, half = self.at(tick, self.y.low)[0], 3.7 * len(short(tick))
            self.line((x, TOP), (x, bottom), 'grid')
            if x - half >= free:
                self.text(x, bottom + 15, short(tick), 'tick')
                free = x + half + 4
        self.line((self.left, bottom), (self.width - RIGHT, bottom), 'axis')
        self.text((self.left + self.width - RIGHT) / 2, self.height - 6, x_name, 'name')
        if y_name:
            self.text(11, (TOP + bottom) / 2, y_name, 'name', upright=True)

    def curve(self, points, ink, kind='curve', title=None, method=None):
        self.polyline([self.at(*p) for p in points], kind, ink.color, title, method, ink.dash)

    def band(self, low, high, color, method=None):
        self.polygon([self.at(*p) for p in low] + [self.at(*p) for p in reversed(high)], 'band', color, None, method)

    def dot(self, x, y, ink, title, method=None, radius=3.6):
        self.symbol(self.at(x, y), radius, 'dot', ink, title, method)

    def touch(self, x, y, color, title, method=None):
        """A place that shows its title and nothing else."""
        self.circle(self.at(x, y), 9, 'touch', color, title, method)

    def box(self, a, b, color, title, kind='box', method=None):
        """A rectangle between two corners in the chart's coordinates."""
        (x1, y1), (x2, y2) = self.at(*a), self.at(*b)
        self.polygon([(x1, y1), (x2, y1), (x2, y2), (x1, y2)], kind, color, title, method)
