"""Commands that are a program of pcrb_tools or a launch file: their options are asked of these, not said again."""
import dataclasses
import functools
import os
import re
import signal
import subprocess
import xml.etree.ElementTree

import places
from places import NotBuilt  # noqa: F401  (for those who call programs)
from options import Option, given
from words import WORDS

# What launch files and nodes call otherwise.
RENAMES = {'problems': 'kind', 'node-launch': 'node', 'sequence': 'name', 'stamps-file': 'scans', 'map-file': 'map',
           'client-command': 'client', 'threads': 'jobs'}
NUMBER_LIMITS = {'POSITIVE': (1e-9, None), 'NONNEGATIVE': (0, None)}


def run_program(command, name=None, **streams):
    """Exit status of a program that has the terminal; an interruption is left to it. KeyboardInterrupt if that ended it."""
    with subprocess.Popen([name or command[0], *command[1:]], executable=command[0], **streams) as process:
        while True:
            try:
                status = process.wait()
                break
            except KeyboardInterrupt:
                continue
    if status == -signal.SIGINT:
        raise KeyboardInterrupt
    return status if status >= 0 else 128 - status


def program(name, package='pcrb_tools'):
    path = places.find_program(name, package)
    if path is None:
        raise NotBuilt(f'found no program {name} of {package}: source devel/setup.bash of a workspace that is built')
    return path


def shared(option):
    """An option under its common name, with the common help and limits where it is a shared word."""
    name = RENAMES.get(option.name, option.name)
    if name == 'input' and not option.positional:  # tum_to_pcd's
        name = 'messages'
    known = WORDS.get(name)
    if known is None:
        return dataclasses.replace(option, name=name)
    default = known.default if option.default is None and not option.required else option.default
    shown = option.shown_default or known.shown_default
    if isinstance(default, str) and (known.many or option.many):
        default = default.split()
    if name == 'jobs' and default != 1:
        default, shown = None, 'all processors'
    return dataclasses.replace(known, default=default, required=option.required, many=known.many or option.many,
                               choices=in_order(option.choices, known.choices), source=option.source, shown_default=shown)


def in_order(choices, known):
    """What a program takes, in the order in which the shared word lists it."""
    return tuple(word for word in known if word in choices) if choices and set(choices) <= set(known) else choices or known


@functools.lru_cache(maxsize=None)
def described(name):
    """The options of a program, as it describes them itself, a line each."""
    text = subprocess.run([program(name), '--describe'], stdout=subprocess.PIPE, check=True, encoding='utf-8').stdout
    return [parse_description(line.split('\t')) for line in text.splitlines()]


def parse_description(fields):
    long, short, place, kind, default, required, most, text = fields
    base, _, limits = kind.partition(':')
    words = re.search(r'\{(.*)\}', limits)
    choices = tuple(sorted(word.split('->')[0] for word in words[1].split(','))) if words else ()
    span = re.search(r'in \[(\S+) - (\S+)\]', limits)
    low, high = (float(span[1]), float(span[2])) if span else NUMBER_LIMITS.get(limits, (None, None))
    base = {'INT': 'int', 'UINT': 'int', 'FLOAT': 'number'}.get(base, 'text') if int(most) > 0 else 'flag'
    if base == 'int' and limits == 'POSITIVE':
        low = 1
    if kind.startswith('UINT') and low is None:
        low = 0
    name = (long.split(',')[0] if long else place.lower()).replace('_', '-')
    bracket = re.search(r'\s*\[([^\]]*)\]$', text)
    if bracket:
        text = text[:bracket.start()]
    return Option(name, text, base, metavar=place.upper().rstrip('S') if place else '', default=typed(base, default), short=short.split(',')[0],
                  required=required == '1', many=int(most) > 1, positional=not long, choices=choices, low=low, high=high,
                  source=f'--{long.split(",")[0]}' if long else '', shown_default=bracket[1] if bracket else '')


def typed(kind, default):
    if default.startswith('[') or default in ('', '""'):
        return None
    if kind == 'int':
        return int(default) if re.fullmatch(r'-?\d+', default) else None
    if kind == 'number':
        return float(default)
    return default


def launch_options(name):
    """The arguments of a launch file as options."""
    path = places.launch_file(name)
    if path is None:
        raise NotBuilt('found no package pcrb_launch: source devel/setup.bash of a workspace that is built')
    return [launch_option(element) for element in xml.etree.ElementTree.parse(path).getroot().findall('arg')
            if 'value' not in element.attrib]


def launch_option(element):
    name, default = element.get('name'), element.get('default')
    is_flag = default in ('true', 'false')
    return Option(name.replace('_', '-'), element.get('doc', name.replace('_', ' ')), 'flag' if is_flag else 'text',
                  default=None if is_flag or not default or '$' in default else default, required=default is None, source=name)


def command_line(options, values):
    """Words for the program behind the options: those that are given, under the program's own names."""
    words = []
    for option in options:
        if not option.source or option.name not in values or not given(option, values):
            continue
        value = values[option.name]
        is_flag = option.kind == 'flag'
        words += [option.source] if is_flag and value else [] if is_flag else [option.source, *texts_of(option, value)]
    return words


def texts_of(option, value):
    return [str(each) for each in (value if option.many else [value])]


class Tool:
    """A command that is a program of pcrb_tools.

    folders  the program takes the folder of one sequence by its place: the command takes --root and --sequences, and
             runs the program for each of them.
    changes  what is different from the program, by option.
    more     further mistakes of values.
    known    the sequences below --root that --sequences may name, where they are there already.
    """

    def __init__(self, name, folders=False, changes=None, more=lambda values: [], known=None):
        self.name, self.folders, self.changes, self.more, self.known = name, folders, changes or {}, more, known
        self.chosen = []  # the sequences, once check() has found them

    def options(self):
        options = []
        for option in described(self.name):
            if option.name == 'folder' and self.folders:
                continue
            is_shared_place = option.positional and option.name in ('root', 'sequences')
            option = shared(dataclasses.replace(option, positional=option.positional and not is_shared_place))
            options.append(dataclasses.replace(option, **self.changes.get(option.name, {})))
        if self.folders:
            options = [dataclasses.replace(WORDS['root'], required=True),
                       dataclasses.replace(WORDS['sequences'], required=True), *options]
        return options

    def check(self, values):
        if not self.folders:
            is_asked = self.known and values['sequences'] and values['root']
            _, mistakes = places.select(values['sequences'], self.known(values), values['root']) if is_asked else ([], [])
            return mistakes + self.more(values)
        self.chosen, mistakes = places.select(values['sequences'], places.cloud_folders(values['root']), values['root'])
        if values.get('output') and len(self.chosen) > 1:
            mistakes.append(f'--output: found {len(self.chosen)} sequences, expected one with --output')
        return mistakes + self.more(values)

    def arguments(self, options, values):
        if self.folders:
            return command_line([option for option in options if option.name not in ('root', 'sequences')], values)
        loose = [option for option in options if not option.source and given(option, values)]
        return [text for option in loose for text in texts_of(option, values[option.name])] + command_line(options, values)

    def run(self, name, options, values):
        words = self.arguments(options, values)
        if not self.folders:
            return run_program([program(self.name), *words], f'pcrb {name}')
        for data_set, sequence in self.chosen:
            folder = os.path.join(values['root'], data_set, sequence)
            status = run_program([program(self.name), folder, *words], f'pcrb {name}')
            if status != 0:
                return status
        return 0
