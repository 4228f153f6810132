"""A client of the benchmark server whose replies a test writes."""
import rospy
from geometry_msgs.msg import PoseStamped
from pcrb_msgs.msg import Problem, Result, Summary
from pcrb_msgs.srv import Ready, SubmitPose, SubmitPoseRequest
from pcrb_testing_wait import wait_until
from sensor_msgs.msg import PointCloud2


class Client:
    """Remembers the newest message of each topic."""

    TOPICS = {'problem': Problem, 'target': PointCloud2, 'source': PointCloud2, 'result': Result, 'summary': Summary}

    def __init__(self, namespace):
        self.namespace = namespace
        self.newest = {}
        self.results = {}
        self._last_stamp = None
        self._subscribers = {
            topic: rospy.Subscriber(f'{namespace}/{topic}', kind, self._take, topic, tcp_nodelay=True)
            for topic, kind in self.TOPICS.items()}
        self._ready = rospy.ServiceProxy(f'{namespace}/ready', Ready)
        self._submit = rospy.ServiceProxy(f'{namespace}/submit_pose', SubmitPose)

    def _take(self, message, topic):
        self.newest[topic] = message
        if topic == 'result':
            self.results[message.problem_id] = message

    def close(self):
        for subscriber in self._subscribers.values():
            subscriber.unregister()

    def has_new_problem(self):
        return 'problem' in self.newest and self.newest['problem'].header.stamp != self._last_stamp

    def next_problem(self):
        """The next announced problem."""
        wait_until(self.has_new_problem, 'a problem is announced')
        problem = self.newest['problem']
        self._last_stamp = problem.header.stamp
        return problem

    def has(self, topic, stamp):
        return topic in self.newest and self.newest[topic].header.stamp == stamp

    def ready(self, problem):
        """Once results will be heard: they are not latched."""
        wait_until(self._subscribers['result'].get_num_connections, 'the server has a listener for its results')
        return self._ready(problem.problem_id)

    def take_source(self, problem, is_over=lambda: False):
        """Calls ready and waits for the problem's target and source; false if the problem ended before."""
        def wait_for(topic, stamp):
            wait_until(lambda: self.has(topic, stamp) or self.has_new_problem() or is_over(), f'the {topic} comes')
            return self.has(topic, stamp)
        if not wait_for('target', problem.target_stamp):
            return False
        self.ready(problem)
        return wait_for('source', problem.header.stamp)

    def submit(self, problem, pose=None, **fields):
        """Replies with a Pose in the target's frame or a PoseStamped; with the initial guess if none is given."""
        request = SubmitPoseRequest(problem_id=problem.problem_id, **fields)
        if isinstance(pose, PoseStamped):
            request.pose = pose
        else:
            request.pose.header = problem.header
            request.pose.pose = pose or problem.initial_guess
        return self._submit(request)

    def result_of(self, problem):
        return wait_until(lambda: self.results.get(problem.problem_id), 'the result comes')

    def serve(self, server, answer=None, limit=None):
        """Answers problems until the server has ended, or until `limit` of them were answered and stored.

        @param answer  called with the client and the problem, after the source has come.
        """
        answer = answer or (lambda client, problem: client.submit(problem))
        count, before = 0, len(server.rows()) if limit else 0
        while count != limit:
            if not wait_until(lambda: self.has_new_problem() or server.ended(), 'the run goes on'):
                break
            if not self.has_new_problem():
                break
            problem = self.next_problem()
            try:
                if self.take_source(problem, server.ended):
                    answer(self, problem)
                    count += 1
            except rospy.ServiceException:
                pass  # the server has ended; if it is not, its problem times out
        if limit:
            wait_until(lambda: len(server.rows()) >= before + count or server.ended(), 'what was answered is stored')
        return count
