#!/usr/bin/env python3
"""evaluate.test passes and fails as its thresholds say, and its report has every number."""
import math
import os
import shutil
import signal
import statistics
import sys
import xml.etree.ElementTree as ElementTree

import roslib.packages
import rospy
import rostest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import pcrb_testing_data as maths
from pcrb_testing import Child, TestCase, executable, rows, run_info, sessions, wait_until

NUMBERS = ('count', 'replied', 'failed', 'timed_out', 'rejected', 'skipped', 'median', 'q75', 'q95', 'mean', 'stddev')


class Report:
    """The JUnit file that evaluation_test wrote."""

    def __init__(self, folder, package='pcrb_launch', name='evaluation'):
        self.suite = ElementTree.parse(os.path.join(folder, package, f'rosunit-{name}.xml')).getroot()
        self.text = self.suite.findtext('system-out')
        self.failures = [case.find('failure').text for case in self.suite.iter('testcase')
                         if case.find('failure') is not None]

    def properties(self, case):
        properties = self.suite.findall(f"./testcase[@name='{case}']/properties/property")
        return {p.get('name'): p.get('value') for p in properties}


class EvaluateTest(TestCase):

    def setUp(self):
        super().setUp()
        self.data = maths.make_data_set(self.path('root'), points=300)

    def rostest(self, *options, **arguments):
        """evaluate.test, with a master of its own unless the options say otherwise."""
        arguments = {'root': self.data.root, 'run': self.path('run'), 'method': 'icp', 'max_median': 100, **arguments}
        return self.start(Child(['rostest', *options, '--results-base-dir', self.path('results'), 'pcrb_launch',
                                 'evaluate.test', *(f'{name}:={value}' for name, value in arguments.items())]))

    def report(self):
        return Report(self.path('results'))

    def assert_fails_with(self, test, *patterns):
        """The patterns are in the report's only failure, and where rostest prints it."""
        self.assertGreater(test.wait(), 0, test.output())
        failures = self.report().failures
        self.assertEqual(len(failures), 1, failures)
        for pattern in patterns:
            self.assertRegex(failures[0], pattern)
            self.assertRegex(test.output(), pattern)

    def test_passes_and_reports_every_number_then_fails_by_each_threshold(self):
        self.assert_ends_well(self.rostest(kind='both', max_median=10, max_q95='10 kitchen:global=20'))
        report = self.report()
        errors = [row['error'] for row in rows(self.path('run'))]
        total = report.properties('total all')
        self.assertEqual((total['count'], total['replied']), (str(len(errors)), str(len(errors))))
        self.assertTrue(math.isclose(float(total['median']), statistics.median(errors), abs_tol=1e-12))
        for case in 'kitchen local', 'kitchen global', 'hall local', 'hall global', 'total all':
            properties = report.properties(case)
            self.assertEqual(set(NUMBERS) - set(properties), set())
            self.assertEqual(properties['max_q95'], '20' if case == 'kitchen global' else '10')
            self.assertRegex(report.text, case.replace(' ', ' +') + f" .* {float(properties['mean']):.4f} ")
        self.assertEqual(report.properties('run finished')['run'], self.path('run'))

        # The run is complete, so these only judge it.
        worst = f'{0.99 * float(total["median"]):.12f}'
        self.assert_fails_with(self.rostest(kind='both', max_median=f'10 total={worst}'),
                               r'total all: median is .*, expected at most .* \(max_median\)')
        self.assert_fails_with(self.rostest(kind='both', max_q95='10 kitchen:local=1e-9'),
                               r'kitchen local: q95 is .*, expected at most 1e-09 \(max_q95\)')
        self.assert_fails_with(self.rostest(kind='both', min_replied=2), r'~min_replied: found `2`')
        self.assert_fails_with(self.rostest(kind='both', max_median='attic=1'), 'not in this run: attic')

    def test_without_a_threshold_or_with_a_misspelt_one_it_fails_with_what_to_give(self):
        for misspelt in {}, {'max_meidan': 1}:
            test = self.rostest(sequences='hall', subset=1, max_median='', **misspelt)
            self.assert_fails_with(test, 'no threshold is given: expected max_median, max_q95 or min_replied')
        test = self.rostest(sequences='hall', subset=1, max_median=10, max_q59=1)
        self.assert_fails_with(test, r"evaluate.test has no argument 'max_q59': expected one of .*\bmax_q95\b")

    def test_every_argument_of_the_file_is_a_known_one(self):
        file = os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__))), 'evaluate.test')
        tree = ElementTree.parse(file)
        declared = [arg.get('name') for arg in tree.getroot().findall('arg')]
        known = next(param.get('value') for param in tree.getroot().find('test') if param.get('name') == 'known_arguments')
        self.assertEqual(known.split(), declared)

    def test_judges_a_localization_node_as_it_is(self):
        data = maths.make_data_set(self.path('rooms'), points=1000)
        node = {'node_launch': 'localization_standins ndt_localizer.launch', 'settle': 'first',
                'node_args': 'map_topic=/points_map scan_topic=/points_raw', 'map_topic': '/points_map',
                'scan_topic': '/points_raw', 'pose_topic': '/ndt_pose'}
        self.assert_ends_well(self.rostest(root=data.root, sequences='hall', subset=2, **node))
        self.assertEqual(self.report().properties('total local')['replied'], '2')
        for row in rows(self.path('run')):
            self.assertLess(row['error'], row['initial_misalignment'])

    def test_takes_a_client_of_the_users_own_and_a_recipe(self):
        self.assert_ends_well(self.rostest(sequences='hall', subset=2, under_test='mine',
                                           client_command=executable('pcrb_tools', 'minimal_client.py')))
        self.assertEqual(run_info(self.path('run'))['under_test'], 'mine')
        for row in rows(self.path('run')):
            self.assertEqual(row['error'], row['initial_misalignment'], 'it replies the guess')
        dump = self.start(Child(['roslaunch', '--dump-params', 'pcrb_launch', 'evaluate.test', f'root:={self.data.root}',
                                 'node:=hdl_localization', 'max_median:=1']))
        self.assert_ends_well(dump)
        self.assertRegex(dump.output(), r'benchmark_server/under_test: hdl_localization')
        self.assertRegex(dump.output(), r'localization_bridge/recipe/')

    def test_fails_soon_where_a_localization_node_does_not_start(self):
        self.assert_fails_with(self.rostest(node_launch='localization_standins no_such.launch'),
                               'the run did not finish: /pcrb/node_supervisor gave up')

    def test_fails_where_too_few_replies_were_valid(self):
        """A thousandth of a second is too short for this method."""
        test = self.rostest(sequences='hall', subset=1, method='ransac', time_limit=0.001)
        self.assertGreater(test.wait(), 0, test.output())
        self.assertRegex(self.report().failures[0], r'replied fraction is 0, expected at least 1 \(min_replied\)')
        self.assertEqual(self.report().properties('hall local')['timed_out'], '1')

    def test_a_server_that_dies_fails_with_a_clear_message(self):
        test = self.rostest(client='false')
        session = wait_until(lambda: sessions(self.path('run')), 'the server has started')[-1]
        test.wait_for_output('waiting for a client')
        os.kill(session['pid'], signal.SIGKILL)
        self.assert_fails_with(test, 'the run did not finish', '/pcrb/benchmark_server died or gave up', 'result: none')

    def test_a_server_that_does_not_start_fails_with_a_clear_message(self):
        test = self.rostest(sequences='attic')
        self.assert_fails_with(test, 'the run did not finish', '/pcrb/benchmark_server d')
        self.assertIn('found `attic`', test.output())

    def test_a_run_without_end_fails_when_its_time_is_up(self):
        self.assert_fails_with(self.rostest(client='false', time_limit_total=2),
                               r'not over within 2 s \(time_limit_total\)')

    def test_parameters_left_on_a_long_lived_master_do_no_harm(self):
        for node in 'benchmark_server', 'registration_node', 'evaluation':
            rospy.set_param(f'/pcrb/{node}/colour', 'red')
        self.assert_ends_well(self.rostest('--reuse-master', sequences='hall'))
        self.assertEqual(self.report().properties('total local')['count'], str(len(self.data.of('local', 'hall'))))

    def test_the_example_package_is_built_and_tested_like_any_other(self):
        source, build = self.path('my_node_evaluation'), self.path('build')
        example = os.path.join(roslib.packages.get_pkg_dir('pcrb_launch'), 'examples', 'my_node_evaluation')
        shutil.copytree(example, source)
        environment = {'PCRB_ROOT': self.data.root, 'CATKIN_TEST_RESULTS_DIR': '', 'TMPDIR': self.path('tmp'),
                       'ROS_PACKAGE_PATH': f'{source}:{os.environ["ROS_PACKAGE_PATH"]}'}
        os.mkdir(self.path('tmp'))
        with open(self.path('tmp', 'pcrb'), 'w'):
            pass  # what is called so belongs to somebody else
        self.assert_ends_well(self.start(Child(
            ['cmake', '-S', source, '-B', build, f'-DPYTHON_EXECUTABLE={sys.executable}', '-Wno-dev'], **environment)))
        tests = self.start(Child(['make', '-C', build, 'run_tests'], **environment))
        self.assert_ends_well(tests)
        report = Report(os.path.join(build, 'test_results'), 'my_node_evaluation')
        self.assertEqual(report.failures, [], tests.output())
        self.assertEqual(report.properties('total local')['count'], str(len(self.data.of('local'))))


if __name__ == '__main__':
    rospy.init_node('evaluate_test')
    rostest.rosrun('pcrb_launch', 'evaluation', EvaluateTest)
