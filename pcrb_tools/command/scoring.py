"""pcrb score and pcrb bag: programs that take a problem file or the folder of a sequence, found from root and sequence."""
import dataclasses
import os

import places
from options import given
from programs import Tool, command_line, program, run_program
from words import WORDS


class OfOneSequence:
    """A command about one sequence: its problems of --kind, or its clouds where no kind is given."""
    front = ()

    def __init__(self):
        self.front = [dataclasses.replace(WORDS['root'], required=True),
                      dataclasses.replace(WORDS['sequences'], required=True, many=False),
                      dataclasses.replace(WORDS['kind'], choices=('local', 'global'), default=None,
                                          shown_default='the sequence itself')]

    def check(self, values):
        known = ([(d, s) for d, s, _, _ in places.problem_files(values['root'], values['kind'])] if values['kind'] else
                 places.cloud_folders(values['root']))
        chosen, mistakes = places.select([values['sequences']], known, values['root'])
        if len(chosen) > 1:
            mistakes.append(f'--sequences: found {len(chosen)} called `{values["sequences"]}`, expected one, data_set/sequence')
        self.chosen = chosen[:1]
        return mistakes

    def place(self, values):
        data_set, sequence = self.chosen[0]
        folder = os.path.join(values['root'], data_set, sequence)
        return f'{folder}_{values["kind"]}.txt' if values['kind'] else folder

    def own_options(self, *tools, drop=()):
        """Options of both programs, each once, without those that say what root, sequences and kind say."""
        options, seen = [], set(drop) | {'folder', 'problem-file', 'name'}
        for tool in tools:
            for option in tool.options():
                if option.name not in seen:
                    seen.add(option.name)
                    options.append(dataclasses.replace(option, required=False))
        return options

    def foreign(self, tool, other, values):
        """Options that are given and that only the other program has."""
        own = {option.name for option in tool.options()}
        return [f'--{option.name}: goes {"without" if values["kind"] else "with"} --kind only' for option in other.options()
                if option.name in values and option.name not in own and not option.positional and given(option, values)]


class Score(OfOneSequence):
    tool = Tool('score_poses')

    def options(self):
        return [*self.front, *self.own_options(self.tool)]

    def check(self, values):
        mistakes = super().check(values)
        needed = 'run' if values['kind'] else 'output'
        if not values['poses']:
            mistakes.append(f'--poses: must be given: {WORDS["poses"].help}')
        if not values[needed]:
            mistakes.append(f'--{needed}: must be given: folder of the results')
        return mistakes

    def run(self, name, options, values):
        place = [self.place(values)] if values['kind'] else ['--sequence', self.place(values)]
        return run_program([program('score_poses'), *place, *command_line(self.tool.options(), values)], 'pcrb score')


class Bag(OfOneSequence):
    sequence, problems = Tool('sequence_to_bag'), Tool('problems_to_bag')

    def options(self):
        options = self.own_options(self.sequence, self.problems, drop=('period',))
        return [*self.front, *(dataclasses.replace(o, required=o.name == 'output') for o in options)]

    def check(self, values):
        tools = (self.problems, self.sequence) if values['kind'] else (self.sequence, self.problems)
        skip = {**values, 'rate': None}
        return super().check(values) + self.foreign(*tools, {k: v for k, v in skip.items() if v is not None})

    def run(self, name, options, values):
        if not values['kind']:
            return run_program([program('sequence_to_bag'), self.place(values), *command_line(self.sequence.options(), values)], 'pcrb bag')
        period = ['--period', f'{1 / values["rate"]:.17g}']
        return run_program([program('problems_to_bag'), self.place(values), *period, *command_line(self.problems.options(), values)], 'pcrb bag')
