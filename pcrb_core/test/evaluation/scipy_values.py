#!/usr/bin/python3
"""Prints the values that correlation_test, paired_test_test and bootstrap_test hold from scipy
(python3-scipy; made with 1.10.1). The data are those of integer formulas which both sides compute."""
import numpy as np
from scipy import stats


def series(count, factor, modulus, scale):
    return np.array([(i * factor + 13) % modulus / scale for i in range(count)])


def show(name, *values):
    print(name, *(repr(float(value)) for value in values))


x, y = series(200, 7919, 101, 10), series(200, 104729, 97, 8)
show('spearman, ties, weak', *stats.spearmanr(x, y))
show('spearman, strong', *stats.spearmanr(x, x + 0.5 * y))
show('spearman, 6 pairs', *stats.spearmanr(x[:6], y[:6]))
for count, shift in ((10, 1.0), (40, 1.0), (200, 0.5)):
    difference = series(count, 7919, 1009, 100) - series(count, 104729, 997, 100) + shift
    averages = np.add.outer(difference, difference)[np.triu_indices(count)] / 2
    show(f'wilcoxon {count}', *stats.wilcoxon(difference), np.median(averages))
ties = np.round(series(90, 7919, 101, 20) - series(90, 104729, 97, 20), 0)
show('wilcoxon with ties and zeros', np.count_nonzero(ties), *stats.wilcoxon(ties))


def positive_ranks(differences):
    return stats.rankdata(np.abs(differences))[differences > 0].sum()


few = (ties + 1)[ties != -1][:12]  # few enough for every choice of signs; scipy 1.10's wilcoxon is not exact with ties
show('wilcoxon of few with ties', *few, positive_ranks(few),
     stats.permutation_test((few,), positive_ranks, permutation_type='samples', n_resamples=np.inf).pvalue)
interval = stats.bootstrap((series(200, 7919, 1009, 100),), np.median, n_resamples=200000, method='percentile',
                           random_state=1).confidence_interval
show('bootstrap of the median', *interval)
