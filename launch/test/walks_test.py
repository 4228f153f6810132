#!/usr/bin/env python3
"""Three afternoons, walked as their users would, in a shell that knows nothing but a sourced workspace: from a method of one's own to
a LaTeX table, from a run to its worst problem in rviz, from a package to a red and a green CI."""
import html
import os
import re
import shlex
import shutil
import signal
import sys

import numpy as np
import rostest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import pcrb_testing_data as maths
from look_test import roles
from pcrb_testing import Child, TestCase, executable, rows
from pcrb_testing_screen import Screen, require_screen, started_and_seen

SETUP = os.path.realpath(os.path.join(os.path.dirname(executable('pcrb_tools', 'report')), '..', '..', 'setup.bash'))
CENTER = '''
    T = np.asarray(target, dtype=float).mean(axis=0) - np.asarray(source, dtype=float).mean(axis=0)
    guess.position.x, guess.position.y, guess.position.z = T
    guess.orientation.x = guess.orientation.y = guess.orientation.z = 0.0
    guess.orientation.w = 1.0
    return guess
'''  # what the student puts in the place of `return guess`
CENTER_IN_CPP = '''
  geometry_msgs::Pose pose;
  for (const auto& p : target) {
    pose.position.x += p[0] / double(target.size());
    pose.position.y += p[1] / double(target.size());
    pose.position.z += p[2] / double(target.size());
  }
  for (const auto& p : source) {
    pose.position.x -= p[0] / double(source.size());
    pose.position.y -= p[1] / double(source.size());
    pose.position.z -= p[2] / double(source.size());
  }
  pose.orientation.w = 1.0;
  return pose;
'''
METHODS = '''
mkdir -p ws/src
cp -r "$(rospack find pcrb_core)/examples/my_method" "$(rospack find pcrb_tools)/examples/my_client" ws/src/
cp "$(rospack find pcrb_tools)/examples/minimal_client.cpp" ws/src/my_client/my_client.cpp
cp "$(rospack find pcrb_tools)/examples/minimal_client.py" my_client.py
python3 edit.py
catkin_make -C ws
. ws/devel/setup.bash
'''
TABLE = '''
pcrb run --root root --run in_cpp --client "rosrun my_client my_client" --sequences kitchen --subset 4
pcrb paper --root root --run paper --method icp center --client "python3 $PWD/my_client.py" --sequences kitchen --subset 4 --no-figures
pcrb paper --root root --run paper --method my_method --plugin ws/devel/lib/libmy_method.so \\
  --parameters ws/src/my_method/my_method.yaml --sequences kitchen --subset 4 --no-figures
pcrb report paper/icp paper/my_method "by centroid=paper/center" --output report --no-figures
'''
PAPER = '''\\documentclass{article}\\usepackage{booktabs}\\begin{document}
\\input{report/report.tex}
\\end{document}
'''


class WalksTest(TestCase):

    def setUp(self):
        super().setUp()
        self.data = maths.make_data_set(self.path('root'), points=400, perturbations=4)
        os.mkdir(self.path('home'))

    def shell(self, script, **variables):
        """A script of bash below the test's folder, that stops at the first failure; no variable of this test's ROS reaches it."""
        fresh = {'HOME': self.path('home'), 'PATH': '/usr/bin:/bin', 'LANG': 'C.UTF-8', 'ROS_IP': '127.0.0.1', **variables}
        words = [f'{name}={value}' for name, value in fresh.items()]
        text = f'set -e\ncd {shlex.quote(self.folder)}\n. {shlex.quote(SETUP)}\n{script}'
        return self.start(Child(['env', '-i', *words, 'bash', '-c', text]))

    def walk(self, script, **variables):
        """What a script printed that must end well."""
        child = self.shell(script, **variables)
        self.assertEqual(child.wait(1200), 0, child.output())
        return child.output()

    def errors(self, *run):
        return {row['problem_id']: row['error'] for row in rows(self.path(*run))}

    def test_from_a_method_of_ones_own_to_a_latex_table(self):
        self.write('edit.py', f'''
for path, old, new in (('my_client.py', '    return guess\\n', {CENTER!r}),
                       ('ws/src/my_client/my_client.cpp', '  return guess;\\n', {CENTER_IN_CPP!r}),
                       ('ws/src/my_client/my_client.cpp', '/*target*/', 'target'),
                       ('ws/src/my_client/my_client.cpp', '/*source*/', 'source'),
                       ('ws/src/my_client/my_client.cpp', '& guess)', '&)')):
    text = open(path).read()
    assert text.count(old) == 1, (path, old)
    open(path, 'w').write(text.replace(old, new))
''')
        self.walk(METHODS)
        self.walk('. ws/devel/setup.bash\n' + TABLE)
        python, cpp, plugin = (self.errors(*run) for run in (['paper', 'center'], ['in_cpp'], ['paper', 'my_method']))
        self.assertEqual(len(python), 4)
        self.assertEqual(python.keys(), cpp.keys())  # the same problems: all three decode the same clouds
        np.testing.assert_allclose([cpp[name] for name in python], list(python.values()), rtol=1e-5)
        self.assertEqual(plugin.keys(), python.keys())
        with open(self.path('report', 'report.tex'), encoding='utf-8') as file:
            self.assertRegex(file.read(), r' & icp & my\\_method & by centroid & do nothing')
        if shutil.which('pdflatex'):
            self.write('paper.tex', PAPER)
            self.walk('pdflatex -interaction=nonstopmode -halt-on-error paper')

    def test_from_a_run_to_its_worst_problem_in_rviz(self):
        require_screen()
        self.walk('''
pcrb run --root root --run "runs/my icp" --method icp --sequences hall --subset 6
pcrb report "runs/my icp" --output report --no-figures
''')
        with open(self.path('report', 'index.html'), encoding='utf-8') as file:
            command = html.unescape(re.search('<code>(pcrb replay .*?)</code>', file.read())[1])
        os.mkdir(self.path('screen'))
        screen = self.start(Screen(self.path('screen')))
        worst = max(self.errors('runs', 'my icp').items(), key=lambda entry: entry[1])
        background, topics = roles('problems')

        def interrupt(replay):
            os.killpg(replay.process.pid, signal.SIGINT)  # Ctrl-C, which ends rviz and the master, too
            replay.wait()

        replay, _ = started_and_seen(lambda: self.shell(f'exec {command}', **screen.environment()), interrupt,
                                     screen, background, [topics['/pcrb/source_aligned']])
        replay.wait_for_output(f'1/1 rooms/hall local {worst[0]}: error {worst[1]:.3g} ')
        interrupt(replay)

    def test_from_a_package_to_a_red_and_a_green_ci(self):
        ci = '''
ROS_PACKAGE_PATH=$PWD/packages:$ROS_PACKAGE_PATH
cmake -S packages/my_node_evaluation -B build -DPYTHON_EXECUTABLE=/usr/bin/python3 -Wno-dev
make -C build run_tests
catkin_test_results build/test_results
'''
        self.walk('mkdir packages && cp -r "$(rospack find pcrb_launch)/examples/my_node_evaluation" packages/')
        variables = {'PCRB_ROOT': self.data.root, 'PCRB_SEQUENCES': 'kitchen'}
        self.assertIn('0 errors, 0 failures', self.walk(ci, **variables))
        test = self.path('packages', 'my_node_evaluation', 'test', 'my_node.test')
        with open(test, encoding='utf-8') as file:
            text = file.read()
        self.write(test, text.replace('name="max_median" value="0.5"', 'name="max_median" value="1e-9"'))
        red = self.shell(ci, **variables)
        self.assert_fails(red, r'median is .*, expected at most 1e-09 \(max_median\)', '2 failures')
        self.walk('''
pcrb run --root root --run reference --method icp
pcrb run --root root --run same --method icp
pcrb run --root root --run worse --client "rosrun pcrb_tools minimal_client.py"
pcrb compare reference same --max-increase 5
''')
        self.assert_fails(self.shell('pcrb compare reference worse --max-increase 5'), 'total +local .* worse')


if __name__ == '__main__':
    rostest.rosrun('pcrb_launch', 'walks', WalksTest)
