"""Waiting on conditions, the only way in which the rostests wait."""
import time

LIMIT = 60.0  # s; no test waits for this long when all is well


def wait_until(condition, what, limit=LIMIT, period=0.002):
    """The condition's first true value; it is looked at every `period` s."""
    end = time.monotonic() + limit
    while True:
        value = condition()
        if value:
            return value
        if time.monotonic() > end:
            raise AssertionError(f'waited {limit:g} s in vain until {what}')
        time.sleep(period)
