"""Charts of sweeps: the median error over the values of a parameter."""
import charts
from drawing import Chart, Linear, Logarithmic, error, interval_text


def sweeps(table, untouched=None):
    """A chart per series and parameter whose values are numbers, with a line at the baseline's error."""
    groups = {}
    for row in charts.rows_of(table):
        if isinstance(row['value'], (int, float)):
            groups.setdefault((row['series'], row['parameter']), []).append(row)
    return [{'name': f'{series}: error over {parameter}', 'drawing': curve(parameter, rows, untouched)}
            for (series, parameter), rows in groups.items()]


def curve(parameter, rows, untouched):
    rows = sorted(rows, key=lambda row: row['value'])
    values = [row['value'] for row in rows]
    is_wide = values[0] > 0 and values[-1] > 20 * values[0]
    x = Logarithmic(values[0] / 1.2, values[-1] * 1.2) if is_wide else Linear(min(values), max(max(values), min(values) + 1e-9))
    ends = [row[name] for row in rows for name in ('low', 'median', 'high') if row[name] is not None]
    ends += [] if untouched is None else [untouched]
    low, high = max(min(ends), charts.SMALLEST), max(max(ends), 2 * charts.SMALLEST)
    chart = Chart(x, Logarithmic(low / 1.3, high * 1.3), parameter, 'median error', label=f'error over {parameter}')
    charts.draw_untouched(chart, untouched)
    ink = charts.inks_for([parameter])[parameter]
    known = [row for row in rows if row['low'] is not None]
    if len(known) > 1:
        chart.band([(row['value'], row['low']) for row in known], [(row['value'], row['high']) for row in known], ink.color)
    chart.curve([(row['value'], row['median']) for row in rows], ink)
    for row in rows:
        chart.dot(row['value'], row['median'], ink, f'{parameter} {row["value"]:g}: median {error(row["median"])}, {interval_text(row)}')
    return chart
