"""What the page shows of trackers: their paths over the map, and their errors over time."""
import charts
from svg import Chart, Linear, Logarithmic, coordinate, error


def square(points):
    """Two axes with one scale that hold all points, and the height of a chart that does not distort them."""
    xs, ys = [x for x, _ in points], [y for _, y in points]
    middle = ((min(xs) + max(xs)) / 2, (min(ys) + max(ys)) / 2)
    half = max(max(xs) - min(xs), max(ys) - min(ys), 1.0) / 2 * 1.05
    return Linear(middle[0] - half, middle[0] + half), Linear(middle[1] - half, middle[1] + half)


def paths(group, colors):
    """The truth, the estimates, and what the scans show from above."""
    everything = group['map'] + group['truth'] + [point for tracker in group['trackers'] for point in tracker['path']]
    x, y = square(everything)
    chart = Chart(x, y, 'x (m)', 'y (m)', 414, 'trajectories over the map')
    squares = ''.join(f'M{coordinate(a)} {coordinate(b)}h1.6v1.6h-1.6z' for a, b in (chart.at(*point) for point in group['map']))
    chart.add(f'<path d="{squares}" class="ground"/>')
    chart.curve(group['truth'], 'currentColor', 'curve baseline')
    for tracker in group['trackers']:
        chart.curve(tracker['path'], colors[tracker['name']])
        for point in tracker['path'][::max(1, len(tracker['path']) // 100)]:
            chart.dot(*point, colors[tracker['name']], f'{tracker["name"]}: {point[0]:.2f}, {point[1]:.2f} m', 'touch')
    return chart.svg()


def errors(group, colors):
    """The benchmark's error of each scan; a gap and a mark at the bottom where it was lost."""
    values = [value for tracker in group['trackers'] for _, value in tracker['errors'] if value is not None]
    end = max(time for tracker in group['trackers'] for time, _ in tracker['errors'])
    low = max(min(values), charts.SMALLEST)
    chart = Chart(Linear(0, max(end, 1e-9)), Logarithmic(low / 1.3, max(max(values), 1.01 * low) * 1.3), 'time (s)', 'error',
                  label='error over time')
    for tracker in group['trackers']:
        color, run = colors[tracker['name']], []
        for time, value in [*tracker['errors'], (None, None)]:
            if value is not None:
                run.append((time, max(value, charts.SMALLEST)))
                continue
            if len(run) > 1:
                chart.curve(run, color)
            for point in run if len(run) == 1 else ():
                chart.dot(*point, color, f'{tracker["name"]}: {error(point[1])}')
            run = []
            if time is not None:
                chart.dot(time, chart.y.low, color, f'{tracker["name"]}: lost at {time:.2f} s')
    return chart.svg()


def view(trackers):
    """Charts of each group of trackers that had the same scans; None without trackers."""
    if not trackers:
        return None
    names = [row[0] for row in trackers['table']['rows']]
    colors = {name: charts.COLORS[i % len(charts.COLORS)] for i, name in enumerate(names)}
    views = [{'names': ', '.join(tracker['name'] for tracker in group['trackers']),
              'paths': paths(group, colors), 'errors': errors(group, colors)} for group in trackers['groups']]
    return {'table': trackers['table'], 'colors': colors, 'groups': views}
