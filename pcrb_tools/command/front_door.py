"""pcrb's main: finds the command, checks its command line, runs it."""
import os
import re
import shutil
import signal
import sys
import textwrap
import xml.etree.ElementTree

import places
import terminal
from commands import COMMANDS
from options import Reader, UsageError, did_you_mean
from programs import NotBuilt

USAGE_ERROR, INTERRUPTED = 2, 128 + signal.SIGINT
GROUPS = {'data': 'Data', 'run': 'Runs', 'results': 'Results', 'look': 'Look at it', 'help': 'Help'}


def main(words):
    sys.stdout.reconfigure(errors='surrogateescape')  # a path may be of any bytes
    try:
        status = dispatch(words)
        sys.stdout.flush()
        return status
    except UsageError as error:
        for mistake in error.mistakes:
            complain(mistake)
        return USAGE_ERROR
    except NotBuilt as error:
        complain(str(error))
        return 1
    except BrokenPipeError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 1
    except Exception as error:
        if not type(error).__module__.startswith('pcrb.'):
            raise
        complain(str(error))  # of the core: a file and what is wrong with it
        return 1
    except KeyboardInterrupt:
        if sys.stderr.isatty():
            print(file=sys.stderr)  # below the ^C
        complain('interrupted')
        return INTERRUPTED


def complain(text):
    print(terminal.paint('pcrb:', 'red', sys.stderr), text, file=sys.stderr)


def dispatch(words):
    if not words or words[0] in ('-h', '--help', 'help'):
        print(overview(), end='')
        return 0 if words else USAGE_ERROR
    if words[0] == '--version':
        print(f'pcrb {version()}')
        return 0
    command, rest = find(words)
    if command is None:
        return list_formats(words[0])
    options = command.options()
    if any(word in ('-h', '--help') for word in rest):
        print(help_of(command, options), end='')
        return 0
    values = Reader(options).read(rest)
    mistakes = command.backing.check(values)
    if mistakes:
        raise UsageError(mistakes)
    return command.backing.run(command.name, options, values)


def find(words):
    """The command that the first words name, and the words behind; no command for the first half of a name of two words."""
    by_name = {command.name: command for command in COMMANDS}
    halves = {name.split()[0] for name in by_name if ' ' in name}
    if words[0] in halves and len(words) == 1:
        return None, []
    name = ' '.join(words[:2])
    if name in by_name and len(words) > 1:
        return by_name[name], words[2:]
    # A word behind the first half is a misspelt second half, unless a file is called so.
    is_half = words[0] in halves and re.fullmatch('[a-z]+', words[1]) and not os.path.exists(words[1])
    if words[0] in by_name and not is_half:
        return by_name[words[0]], words[1:]
    known = {name.partition(' ')[2] for name in by_name if name.startswith(words[0] + ' ')} or {*by_name, *halves, 'help', '--help', '--version'}
    wrong = words[1] if words[0] in halves else words[0]
    raise UsageError([f'unknown command `{" ".join(words[:2] if words[0] in halves else words[:1])}`'
                      + (did_you_mean(wrong, known) or ' (pcrb --help lists them)')])


def list_formats(name):
    for command in COMMANDS:
        if command.name.split()[0] == name:
            print(f'pcrb {command.name.ljust(20)} {command.summary}')
    return 0


def version():
    folder = places.package_folder('pcrb_tools')
    if folder is None:
        raise NotBuilt('found no package pcrb_tools: source devel/setup.bash of a workspace that is built')
    return xml.etree.ElementTree.parse(os.path.join(folder, 'package.xml')).getroot().findtext('version')


def overview():
    lines = ['usage: pcrb COMMAND [OPTIONS]', '', 'Benchmarks point cloud registration and localization.']
    for group, title in GROUPS.items():
        lines += ['', terminal.paint(title, 'bold')]
        for command in COMMANDS:
            lines += describe(command.name, command.summary, 17) if command.group == group else []
    lines += ['', 'pcrb COMMAND --help lists the options of a command,', 'pcrb recipes shows common tasks.']
    return '\n'.join(lines) + '\n'


def help_of(command, options):
    places_first = [option for option in options if option.positional]
    named = sorted((option for option in options if not option.positional), key=lambda option: not option.required)
    required = [option.usage() for option in named if option.required]
    usage = ' '.join([f'pcrb {command.name}', *(option.placeholder() for option in places_first), *required, '[OPTIONS]'])
    summary = textwrap.wrap(command.summary[0].upper() + command.summary[1:] + '.', columns())
    lines = [f'usage: {usage}', '', *summary, '']
    width = min(34, max([len(option.usage()) for option in [*places_first, *named]] or [0]))
    for option in [*places_first, *named]:
        lines += describe(option.usage(), option.explanation(), width)
    return '\n'.join([*lines, '', f'Example: {command.example}']) + '\n'


def describe(usage, text, width):
    wrapped = textwrap.wrap(text, columns() - width - 4) or ['']
    first = [f'  {usage.ljust(width)}  {wrapped[0]}'] if len(usage) <= width else [f'  {usage}', ' ' * (width + 4) + wrapped[0]]
    return first + [' ' * (width + 4) + line for line in wrapped[1:]]


def columns():
    return max(60, min(110, shutil.get_terminal_size((100, 24)).columns))
