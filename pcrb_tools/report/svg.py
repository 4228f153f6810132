"""Charts as SVG text: every number can be read from a tooltip (`<title>`, which the page's script also shows on a
tap). Drawn 440 units wide, so that text stays readable where a phone scales them down."""
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


class Chart:
    """A frame with two axes and what is drawn into it."""

    def __init__(self, x, y, x_name, y_name, height=250, label='', left=LEFT):
        self.x, self.y, self.height, self.label, self.left = x, y, height, label, left
        self.parts = []
        self.draw_axes(x_name, y_name)

    def at(self, x, y):
        return (self.left + self.x(x) * (WIDTH - self.left - RIGHT), self.height - BOTTOM - self.y(y) * (self.height - TOP - BOTTOM))

    def add(self, text):
        self.parts.append(text)

    def text(self, x, y, text, kind='', anchor='middle'):
        self.add(f'<text x="{coordinate(x)}" y="{coordinate(y)}" text-anchor="{anchor}" class="{kind}">{escape(text)}</text>')

    def draw_axes(self, x_name, y_name):
        bottom = self.height - BOTTOM
        for tick in self.y.ticks(4):
            y = self.at(self.x.low, tick)[1]
            self.line((self.left, y), (WIDTH - RIGHT, y), 'grid')
            self.text(self.left - 6, y + 4, short(tick), 'tick', 'end')
        for tick in self.x.ticks():
            x = self.at(tick, self.y.low)[0]
            self.line((x, TOP), (x, bottom), 'grid')
            self.text(x, bottom + 15, short(tick), 'tick')
        self.line((self.left, bottom), (WIDTH - RIGHT, bottom), 'axis')
        self.text((self.left + WIDTH - RIGHT) / 2, self.height - 6, x_name, 'name')
        middle = (TOP + bottom) / 2
        self.add(f'<text transform="translate(11 {middle:g}) rotate(-90)" text-anchor="middle" class="name">'
                 f'{escape(y_name)}</text>')

    def line(self, a, b, kind, color=None, title=None):
        style = f' style="stroke:{color}"' if color else ''
        points = f'x1="{coordinate(a[0])}" y1="{coordinate(a[1])}" x2="{coordinate(b[0])}" y2="{coordinate(b[1])}"'
        self.add(f'<line {points} class="{kind}"{style}>{tip(title)}</line>')

    def curve(self, points, color, kind='curve', title=None):
        where = ' '.join(f'{coordinate(x)},{coordinate(y)}' for x, y in (self.at(*p) for p in points))
        self.add(f'<polyline points="{where}" class="{kind}" style="stroke:{color}">{tip(title)}</polyline>')

    def band(self, low, high, color):
        outline = [self.at(*p) for p in low] + [self.at(*p) for p in reversed(high)]
        where = ' '.join(f'{coordinate(x)},{coordinate(y)}' for x, y in outline)
        self.add(f'<polygon points="{where}" class="band" style="fill:{color}"/>')

    def dot(self, x, y, color, title, kind='dot'):
        a, b = self.at(x, y)
        radius = 9 if kind == 'touch' else 3.5
        self.add(f'<circle cx="{coordinate(a)}" cy="{coordinate(b)}" r="{radius}" class="{kind}" style="fill:{color}">'
                 f'{tip(title)}</circle>')

    def box(self, a, b, color, title, kind='box'):
        """A rectangle between two corners in the chart's coordinates."""
        (x1, y1), (x2, y2) = self.at(*a), self.at(*b)
        self.add(f'<rect x="{coordinate(min(x1, x2))}" y="{coordinate(min(y1, y2))}" width="{coordinate(abs(x2 - x1))}" '
                 f'height="{coordinate(abs(y2 - y1))}" class="{kind}" style="fill:{color}">{tip(title)}</rect>')

    def svg(self):
        return (f'<svg viewBox="0 0 {WIDTH} {self.height}" role="img" aria-label="{escape(self.label, quote=True)}">'
                + ''.join(self.parts) + '</svg>')


def tip(title):
    return f'<title>{escape(title)}</title>' if title else ''
