"""The chart of covariances: how many errors lie in the ellipsoid of each probability."""
from drawing import Chart, Linear


def curves(numbers, inks):
    """Below the diagonal: overconfident; above it: underconfident. None where no reply came with a covariance."""
    if not numbers['curves']:
        return None
    chart = Chart(Linear(0, 1), Linear(0, 1), 'probability of the ellipsoid', 'errors inside', label='calibration of covariances')
    chart.line(chart.at(0, 0), chart.at(1, 1), 'median', title='right covariances')
    for curve in numbers['curves']:
        points = list(zip(numbers['probabilities'], curve['fractions']))
        chart.curve(points, inks[curve['method']], method=curve['method'])
        for probability, fraction in points[::2]:
            chart.touch(probability, fraction, inks[curve['method']].color,
                        f'{curve["method"]}: {100 * fraction:.1f} % of the errors in the {100 * probability:.0f} % ellipsoid', curve['method'])
    return chart
