"""What the page shows of trackers: their paths over the map, and their errors over time."""
import charts
from drawing import Chart, Linear, Logarithmic, error


def square(points):
    """Two axes with one scale that hold all points, and the height of a chart that does not distort them."""
    xs, ys = [x for x, _ in points], [y for _, y in points]
    middle = ((min(xs) + max(xs)) / 2, (min(ys) + max(ys)) / 2)
    half = max(max(xs) - min(xs), max(ys) - min(ys), 1.0) / 2 * 1.05
    return Linear(middle[0] - half, middle[0] + half), Linear(middle[1] - half, middle[1] + half)


def paths(group, inks):
    """The truth, the estimates, and what the scans show from above."""
    everything = group['map'] + group['truth'] + [point for tracker in group['trackers'] for point in tracker['path']]
    x, y = square(everything)
    chart = Chart(x, y, 'x (m)', 'y (m)', 414, 'trajectories over the map')
    chart.squares([chart.at(*point) for point in group['map']], 1.6, 'ground')
    chart.curve(group['truth'], charts.BASELINE)
    for tracker in group['trackers']:
        chart.curve(tracker['path'], inks[tracker['name']], method=tracker['name'])
        for point in tracker['path'][::max(1, len(tracker['path']) // 100)]:
            chart.touch(*point, inks[tracker['name']].color, f'{tracker["name"]}: {point[0]:.2f}, {point[1]:.2f} m', tracker['name'])
    return chart


def errors(group, inks):
    """The benchmark's error of each scan; a gap and a mark at the bottom where it was lost."""
    values = [value for tracker in group['trackers'] for _, value in tracker['errors'] if value is not None] or [charts.SMALLEST]
    end = max(time for tracker in group['trackers'] for time, _ in tracker['errors'])
    low = max(min(values), charts.SMALLEST)
    chart = Chart(Linear(0, max(end, 1e-9)), Logarithmic(low / 1.3, max(max(values), 1.01 * low) * 1.3), 'time (s)', 'error',
                  label='error over time')
    for tracker in group['trackers']:
        name, ink, run = tracker['name'], inks[tracker['name']], []
        for time, value in [*tracker['errors'], (None, None)]:
            if value is not None:
                run.append((time, max(value, charts.SMALLEST)))
                continue
            if len(run) > 1:
                chart.curve(run, ink, method=name)
            for point in run if len(run) == 1 else ():
                chart.dot(*point, ink, f'{name}: {error(point[1])}', name)
            run = []
            if time is not None:
                chart.dot(time, chart.y.low, ink, f'{name}: lost at {time:.2f} s', name)
    return chart


def view(trackers, figures=()):
    """Charts of each group of trackers that had the same scans; None without trackers."""
    if not trackers:
        return None
    inks = charts.inks_for([row[0] for row in trackers['table']['rows']])
    views = [{'names': ', '.join(tracker['name'] for tracker in group['trackers']), 'paths': paths(group, inks),
              'errors': errors(group, inks), 'inks': {tracker['name']: inks[tracker['name']] for tracker in group['trackers']}}
             for group in trackers['groups']]
    return {'table': trackers['table'], 'inks': inks, 'groups': views, 'figures': figures}
