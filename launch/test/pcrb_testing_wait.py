"""Waiting on conditions, the only way in which the rostests wait."""
import time

LIMIT = 240.0  # s; no test waits for this long when all is well, on a machine with load 20, too


def wait_until(condition, what, limit=LIMIT, period=0.002):
    """The condition's first true value; it is looked at every `period` s, and less often while it takes long."""
    end = time.monotonic() + limit
    while True:
        value = condition()
        if value:
            return value
        if time.monotonic() > end:
            raise AssertionError(f'waited {limit:g} s in vain until {what}')
        time.sleep(period)
        period = max(period, min(1.1 * period, 0.02))
