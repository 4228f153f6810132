#!/usr/bin/env python3
import numpy as np
import rospy
from pcrb_msgs.msg import Problem, Summary
from pcrb_msgs.srv import Ready, SubmitPose, SubmitPoseRequest
from sensor_msgs.msg import PointCloud2


def points_of(cloud):
    """The (n, 3) float32 coordinates, m, of a sensor_msgs/PointCloud2."""
    offsets = {field.name: field.offset for field in cloud.fields}
    layout = np.dtype({'names': ['x', 'y', 'z'], 'formats': ['<f4'] * 3,
                       'offsets': [offsets['x'], offsets['y'], offsets['z']], 'itemsize': cloud.point_step})
    points = np.frombuffer(cloud.data, layout)
    return np.stack([points['x'], points['y'], points['z']], axis=1)


def align(target, source, guess):
    """Your algorithm goes here: the pose T with p_target = T * p_source."""
    return guess


latest = {}


def wait_until(condition):
    while not rospy.is_shutdown() and 'summary' not in latest and not condition():
        rospy.rostime.wallsleep(0.001)
    return not rospy.is_shutdown() and 'summary' not in latest


rospy.init_node('minimal_client')
for name, kind in (('problem', Problem), ('target', PointCloud2), ('source', PointCloud2), ('summary', Summary)):
    rospy.Subscriber('/pcrb/' + name, kind, lambda message, name=name: latest.update({name: message}))
ready = rospy.ServiceProxy('/pcrb/ready', Ready)
submit = rospy.ServiceProxy('/pcrb/submit_pose', SubmitPose)

problem = None
while wait_until(lambda: latest.get('problem') is not problem):
    problem = latest['problem']  # another one may be announced at any time: the time limit goes on
    is_old = lambda: latest['problem'] is not problem
    has = lambda name, stamp: name in latest and latest[name].header.stamp == stamp
    wait_until(lambda: is_old() or has('target', problem.target_stamp))
    ready(problem.problem_id)
    wait_until(lambda: is_old() or has('source', problem.header.stamp))
    if is_old() or 'summary' in latest:
        continue
    reply = SubmitPoseRequest(problem_id=problem.problem_id)
    reply.pose.header = problem.header
    reply.pose.pose = align(points_of(latest['target']), points_of(latest['source']), problem.initial_guess)
    submit(reply)
