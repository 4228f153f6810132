"""Charts of boxes and whiskers, a row each: errors along axes, and latencies."""
from charts import BASELINE, rows_of
from drawing import BOTTOM, LEFT, RIGHT, TOP, Chart, Linear, Logarithmic, error, shortened


class Rows(Chart):
    """Horizontal boxes and whiskers, a row each, in place of the y axis."""

    def __init__(self, x, x_name, rows, label):
        self.rows = rows
        left = min(220, max([LEFT, *(12 + 6.6 * len(row['label']) for row in rows)]))
        super().__init__(x, Linear(0, len(rows)), x_name, '', TOP + BOTTOM + 19 * len(rows), label, left)

    def draw_axes(self, x_name, y_name):
        self.y.ticks = lambda count=0: []
        super().draw_axes(x_name, y_name)
        for i, row in enumerate(self.rows):
            self.text(self.left - 6, self.middle(i) + 4, shortened(row['label'], 30), 'tick', 'end')

    def middle(self, i):
        return TOP + 19 * (i + 0.5)

    def mark_cut(self, low, high, y, method):
        """An arrow with its value for each end of a whisker that leaves the axis."""
        if low < self.x.low:
            self.text(self.left, y + 4, f'◂ {error(low)}', 'beyond', 'start', method)
        if high > self.x.high:
            self.text(self.width - RIGHT, y + 4, f'{error(high)} ▸', 'beyond', 'end', method)

    def draw(self, whiskers, box, median):
        for i, row in enumerate(self.rows):
            title, ink, method = row['title'], row['ink'], row['method']
            y, level = self.middle(i), len(self.rows) - i - 0.5
            x = [self.at(row[q], 0)[0] for q in whiskers]
            self.line((x[0], y), (x[1], y), 'whisker', ink.color, title, method)
            self.mark_cut(row[whiskers[0]], row[whiskers[1]], y, method)
            if box and self.x.low <= row[box[0]] and row[box[1]] <= self.x.high:
                self.box((row[box[0]], level - 0.3), (row[box[1]], level + 0.3), ink.color, title, 'quartiles', method)
            self.dot(row[median], level, ink, title, method)
        return self


def components(table, inks, axes, unit):
    rows = []
    for row in rows_of(table):
        if row['selection'] == 'total' and row['axis'] in axes:
            row['label'], row['ink'] = row['axis'], inks[row['method']]
            row['title'] = (f'{row["method"]}, {row["axis"]}: median {error(row["median"])} {unit}, q25 to q75 {error(row["q25"])} '
                            f'to {error(row["q75"])}, q05 to q95 {error(row["q05"])} to {error(row["q95"])}')
            rows.append(row)
    rows.sort(key=lambda row: axes.index(row['axis']))
    first = {}
    for row in rows:
        row['label'] = '' if first.setdefault(row['axis'], row) is not row else row['axis']
    widest = max([4 * max(abs(row['q25']), abs(row['q75'])) for row in rows if row['ink'] != BASELINE] + [1e-6])
    return Rows(Linear(-widest, widest), f'error in {unit}', rows, f'errors in {unit}').draw(
        ('q05', 'q95'), ('q25', 'q75'), 'median')


def latencies(table, inks):
    rows = []
    for row in rows_of(table):
        if row['selection'] == 'total' and row['median'] is not None:
            row['label'], row['ink'] = row['method'], inks[row['method']]
            row['title'] = (f'{row["method"]}: median {1000 * row["median"]:.1f} ms, q05 to q95 {1000 * row["q05"]:.1f} to '
                            f'{1000 * row["q95"]:.1f} ms, max {1000 * row["max"]:.0f} ms, {row["replies"]} replies')
            rows.append(row)
    if not rows:
        return None
    low, high = min(row['q05'] for row in rows), max(row['q95'] for row in rows)
    return Rows(Logarithmic(max(low, 1e-5) / 1.3, max(high, 2e-5) * 1.3), 's from source to reply', rows, 'latency').draw(
        ('q05', 'q95'), None, 'median')
