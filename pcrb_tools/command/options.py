"""Options of commands: what they are called, what they may be, and how a command line is read.

An option is said once, as an Option; help, checks, completion and the table in docs/pcrb.md come from it.
"""
import dataclasses
import difflib
import math
import os
import re
from typing import Any, Optional, Sequence


OLD_NAMES = {'threads': 'jobs', 'truth': 'publish-ground-truth'}
PLACEHOLDERS = {'int': 'N', 'number': 'X', 'folder': 'DIR', 'file': 'FILE', 'path': 'PATH'}  # by kind


class UsageError(Exception):
    """What is wrong with a command line, a line each."""

    def __init__(self, mistakes):
        super().__init__('\n'.join(mistakes))
        self.mistakes = list(mistakes)


@dataclasses.dataclass(frozen=True)
class Option:
    """One option. Its name has hyphens; on a command line it is --name VALUE, --name=VALUE or name:=VALUE."""
    name: str
    help: str
    kind: str = 'text'  # text, path, folder and file (must be there), int, number, flag
    metavar: str = ''
    default: Any = None
    short: str = ''
    required: bool = False
    many: bool = False  # takes several words
    positional: bool = False  # given by its place alone
    choices: Sequence[str] = ()
    low: Optional[float] = None
    high: Optional[float] = None
    source: str = ''  # what the program behind the command calls it
    shown_default: str = ''  # in words, where it is not one value

    def placeholder(self):
        if self.kind == 'flag':
            return ''
        choices = '|'.join(self.choices)
        word = self.metavar or (choices if 0 < len(choices) <= 40 else '') or PLACEHOLDERS.get(self.kind, 'TEXT')
        return word + (' ...' if self.many else '')

    def usage(self):
        """E.g. `-o, --output DIR`."""
        if self.positional:
            return self.placeholder()
        return ' '.join(filter(None, [(f'-{self.short}, ' if self.short else '') + f'--{self.name}', self.placeholder()]))

    def explanation(self):
        """The help with what may be given, and the default."""
        notes = []
        if self.choices and '|' not in self.placeholder():
            notes.append(', '.join(self.choices))
        elif self.low is not None or self.high is not None:
            notes.append(bounds(self.low, self.high))
        if self.required:
            notes.append('must be given')
        elif self.shown_default or self.default not in (None, '', False, []):
            notes.append(f'default: {self.shown_default or words_of(self.default)}')
        return self.help + (f' ({"; ".join(notes)})' if notes else '')

    def parse(self, text):
        """The value that a word means. Values stay text unless the option is a number: sequence 00 is no 0."""
        if self.choices and text not in self.choices:
            raise ValueError(f'found `{text}`, expected {one_of(self.choices)}{did_you_mean(text, self.choices)}')
        if self.kind == 'flag':
            if text.lower() not in ('true', 'false'):
                raise ValueError(f'found `{text}`, expected true or false')
            return text.lower() == 'true'
        if self.kind in ('int', 'number'):
            return self.parse_number(text)
        if self.kind in ('folder', 'file', 'path'):
            text = os.path.expanduser(text)
        if self.kind == 'folder' and not os.path.isdir(text):
            raise ValueError(f'found `{text}`, expected a folder that is there')
        if self.kind == 'file' and not os.path.isfile(text):
            raise ValueError(f'found `{text}`, expected a file that is there')
        return text

    def parse_number(self, text):
        is_whole = self.kind == 'int'
        if not re.fullmatch(r'[+-]?\d+' if is_whole else r'[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?', text):
            raise ValueError(f'found `{text}`, expected a {"whole " if is_whole else ""}number')
        value = int(text) if is_whole else float(text)
        is_low = self.low is not None and value < self.low
        if not math.isfinite(value) or is_low or self.high is not None and value > self.high:
            raise ValueError(f'found {text}, expected {bounds(self.low, self.high)}')
        return value


def bounds(low, high):
    if high is None or high >= 1e6:
        return 'more than 0' if 0 < low < 1e-6 else f'at least {low:g}'
    return f'at most {high:g}' if low is None else f'{low:g} to {high:g}'


def words_of(value):
    if isinstance(value, float):
        return f'{value:g}'
    return ' '.join(map(str, value)) if isinstance(value, (list, tuple)) else str(value)


def one_of(words):
    words = list(words)
    return words[0] if len(words) == 1 else ', '.join(words[:-1]) + ' or ' + words[-1]


def did_you_mean(word, known):
    close = difflib.get_close_matches(word, list(known), 1, 0.5)
    return f': did you mean {close[0]}?' if close else ''


class Reader:
    """Reads one command line by a table of options, and gathers all that is wrong with it."""

    def __init__(self, options):
        self.named = {option.name: option for option in options if not option.positional}
        self.short = {option.short: option for option in options if option.short}
        self.places = [option for option in options if option.positional]
        self.values = {}
        self.mistakes = []

    def read(self, words):
        """Values by option name; options that are not given have their default, those that take several words a list."""
        words, loose = list(words), []
        while words:
            word = words.pop(0)
            assignment = re.fullmatch(r'([A-Za-z][\w-]*):=(.*)', word, re.DOTALL)
            if word == '--':
                loose += words
                break
            if assignment:
                self.assign(assignment[1].replace('_', '-'), assignment[2], f'{assignment[1]}:=')
            elif is_option(word):
                self.take(word, words)
            else:
                loose.append(word)
        self.place(loose)
        self.complete()
        if self.mistakes:
            raise UsageError(self.mistakes)
        return self.values

    def find(self, name, written):
        for known in (name, OLD_NAMES.get(name)):
            if known in self.named:
                return self.named[known]
        marked = {f'--{known}': known for known in self.named}
        self.mistakes.append(f'unknown option {written}' + (did_you_mean(f'--{name}', marked) or ' (see --help)'))
        return None

    def assign(self, name, text, written):
        option = self.find(name, written)
        if option is not None:
            self.add(option, text.split() if option.many else [text])

    def take(self, word, words):
        name, equals, text = word.partition('=')
        if not name.startswith('--'):
            option = self.short.get(name[1:])
            if option is None:
                self.mistakes.append(f'unknown option {name} (see --help)')
        else:
            option = self.find(name[2:], name)
        if equals:
            given = [text]
        elif option is None or option.kind == 'flag':
            given = [] if option is None else ['true']
        else:
            given = [words.pop(0)] if words and not is_option(words[0]) else []
            while given and option.many and words and not is_option(words[0]) and ':=' not in words[0]:
                given.append(words.pop(0))
        if option is not None:
            self.add(option, given)

    def place(self, loose):
        for option in self.places:
            count = len(loose) if option.many else 1
            if loose:
                self.add(option, loose[:count])
            loose = loose[count:]
        if loose:
            self.mistakes.append(f'found `{" ".join(loose)}` too much (options begin with --, see --help)')

    def add(self, option, given):
        shown = option.placeholder() if option.positional else f'--{option.name}'
        if not given:
            self.mistakes.append(f'{shown}: found no value, expected {option.placeholder()}')
        for text in given:
            try:
                value = option.parse(text)
            except ValueError as error:
                self.mistakes.append(f'{shown}: {error}')
                continue
            if option.many:
                self.values.setdefault(option.name, []).append(value)
            elif option.name in self.values and self.values[option.name] != value:
                self.mistakes.append(f'{shown}: found two values, expected one')
            else:
                self.values[option.name] = value

    def complete(self):
        for option in [*self.places, *self.named.values()]:
            shown = option.placeholder() if option.positional else f'--{option.name}'
            if option.name not in self.values:
                if option.required and not any(mistake.startswith(f'{shown}:') for mistake in self.mistakes):
                    self.mistakes.append(f'{shown}: must be given: {option.help}')
                self.values[option.name] = option.default if option.default is not None else [] if option.many else None


def is_option(word):
    return re.match(r'--?[A-Za-z]', word) is not None


def given(option, values):
    """Whether a value is there that is not the option's default."""
    return values[option.name] not in (None, [], option.default)
