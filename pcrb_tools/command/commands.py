"""The table of pcrb's commands."""
import dataclasses
from typing import Any

import comparison
import demo
import doctor
import places
import probe
import scoring
import texts
from benchmarking import SWEEP, Benchmark, Replay, method_mistakes
from programs import Tool


class Module:
    """A command that is a module here: OPTIONS, check() and run()."""

    def __init__(self, module):
        self.check, self.run, self.module = module.check, module.run, module

    def options(self):
        return self.module.OPTIONS


@dataclasses.dataclass(frozen=True)
class Command:
    name: str
    group: str
    summary: str
    backing: Any
    example: str

    def options(self):
        return self.backing.options()


LOG_FRAME = {'frame': {'name': 'log-frame'}}  # score has the other frame
ROOTED = {'root': {'required': True}}
NEW_ROOT = {'root': {'kind': 'path', 'metavar': 'DIR'}}  # is made where it is not there

COMMANDS = [
    Command('prepare', 'data', 'from original logs to problem files, in stages', Tool('prepare_dataset', changes=NEW_ROOT),
            'pcrb prepare --logs ~/logs --root ~/pcrb --sequences eth/apartment'),
    Command('fetch', 'data', 'download the published data sets, and verify them', Tool('fetch_datasets', changes={
        **NEW_ROOT, 'from': {'kind': 'folder'}}), 'pcrb fetch --logs ~/logs --root ~/pcrb --sequences eth/plain'),
    Command('convert', 'data', 'a log of your own (bags, or clouds and poses) to a data set with problems', Tool('convert_log', changes=NEW_ROOT),
            'pcrb convert drive.bag --root ~/pcrb --data-set mine'),
    *(Command(f'convert {data_set}', 'data', f'a log in the original format of {name} to clouds', Tool(f'{data_set}_to_pcd', changes={**NEW_ROOT, **LOG_FRAME}),
              f'pcrb convert {data_set} ~/logs/{data_set}/{log} --root ~/pcrb')
      for data_set, name, log in (('eth', 'ETH', 'apartment'), ('planetary', 'the planetary data set', 'p2at_met'),
                                  ('tum', 'TUM RGB-D', 'pioneer_slam.bag'), ('kaist', 'KAIST Urban', 'urban05'))),
    Command('overlap', 'data', 'the overlap matrix of sequences', Tool('compute_overlap', folders=True),
            'pcrb overlap --root ~/pcrb --sequences eth/apartment'),
    Command('sample', 'data', 'draw problems from sequences', Tool('sample_problems', folders=True),
            'pcrb sample --root ~/pcrb --sequences eth/apartment --kind local --seed 1'),
    Command('map', 'data', 'merge the clouds of a sequence into a map', Tool('build_map', folders=True),
            'pcrb map --root ~/pcrb --sequences planetary/box_met --output ~/pcrb/planetary/p2at_met/box_map.pcd'),
    Command('import-protocol', 'data', 'problems of the original ETH protocol, with its initial poses', Tool('import_protocol'),
            'pcrb import-protocol apartment_protocol.csv ~/pcrb/eth/apartment --output ~/protocol/eth/apartment_global.txt'),
    Command('check', 'data', 'check data sets: clouds, problems, overlaps', Tool('check_dataset', changes=ROOTED, known=places.all_sequences),
            'pcrb check --root ~/pcrb --sequences eth kaist'),
    Command('run', 'run', 'benchmark a registration method, or a client of your own', Benchmark('benchmark.launch', {}, [SWEEP]),
            'pcrb run --root ~/pcrb --run ~/runs/gicp --method gicp --subset 100'),
    Command('localize', 'run', 'benchmark a localization node as it is', Benchmark('localization.launch', {
        'bridge-parameters': {'kind': 'file', 'metavar': 'FILE'}}),
            'pcrb localize --root ~/pcrb --run ~/runs/my_node --sequences planetary_map --node "my_package my_node.launch"'),
    Command('probe', 'run', 'find out how a localization node is benchmarked', Module(probe),
            'pcrb probe --node "my_package my_node.launch" --output my_node.yaml'),
    Command('paper', 'run', 'the experiments of the paper, seven methods, and a method of your own beside them', Tool('run_paper', changes={
        'sequences': {'default': None, 'shown_default': 'all'}}, more=method_mistakes, known=places.problem_sequences),
            'pcrb paper --root ~/pcrb --run ~/runs/paper --subset 100'),
    Command('score', 'results', 'score poses of problems or of a trajectory, without ROS', scoring.Score(),
            'pcrb score --root ~/pcrb --sequences eth/apartment --kind local --poses mine.txt --run ~/runs/mine'),
    Command('report', 'results', 'compare runs: a page, tables, figures', Tool('report'),
            'pcrb report ~/runs/icp ~/runs/gicp --output report'),
    Command('compare', 'results', 'the differences of two runs as text, for continuous integration', Module(comparison),
            'pcrb compare ~/runs/before ~/runs/after --max-increase 5'),
    Command('merge', 'results', 'put the shards of a run together', Tool('merge_runs'),
            'pcrb merge ~/runs/gicp/shards/* --output ~/runs/gicp'),
    Command('ground-truth', 'results', 'how exact the ground truth is', Tool('evaluate_ground_truth', changes={
        'import': {'name': 'misalignments'}}, known=places.problem_sequences),
            'pcrb ground-truth --root ~/pcrb --sequences eth/apartment --output ground_truth'),
    Command('replay', 'look', 'look at a sequence, its problems, or a finished run', Replay(),
            'pcrb replay --run ~/runs/gicp --order worst --rviz'),
    Command('bag', 'look', 'a sequence or its problems as a bag', scoring.Bag(),
            'pcrb bag --root ~/pcrb --sequences eth/apartment --output apartment.bag'),
    Command('demo', 'help', f'from simulated logs to a report: {demo.COSTS}', Module(demo), 'pcrb demo --output ~/pcrb_demo'),
    Command('doctor', 'help', 'what this machine has and lacks', Module(doctor), 'pcrb doctor --root ~/pcrb'),
    Command('recipes', 'help', 'commands for common tasks', texts.Printer(texts.all_recipes), 'pcrb recipes'),
    Command('completion', 'help', 'what a shell needs to complete pcrb', texts.Printer(texts.completion, [texts.SHELL]),
            'source <(pcrb completion bash)'),
    Command('options', 'help', 'a table of all options of all commands', texts.Printer(texts.table), 'pcrb options'),
]
texts.COMMANDS = COMMANDS
