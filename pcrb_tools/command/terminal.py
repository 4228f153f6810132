"""What is written to a terminal: colours there only."""
import os
import sys

COLORS = {'green': '32', 'yellow': '33', 'red': '31', 'bold': '1'}


def paint(text, color, stream=sys.stdout):
    if not stream.isatty() or os.environ.get('NO_COLOR') or os.environ.get('TERM') == 'dumb':
        return text
    return f'\033[{COLORS[color]}m{text}\033[0m'


def say(text):
    print(paint('==>', 'bold'), text, flush=True)
