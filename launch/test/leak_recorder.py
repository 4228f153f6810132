"""Records what a run shows on ROS interfaces: messages, parameters, names, and what a client is told."""
import io
import threading

import rosgraph
import roslib.message
import rospy
from leak_detector import record
from pcrb_testing_wait import wait_until


class Recorder:
    """Listens to every topic there is. `moment` is the index of the problem in flight, set by the test."""

    def __init__(self):
        self.records = []
        self.moment = -1
        self.unreadable = set()  # types without a Python module, which is an error
        self._master = rosgraph.Master(rospy.get_name())
        self._subscribers = {}
        self._seen = set()
        self._lock = threading.Lock()

    def close(self):
        while self._subscribers:
            self._subscribers.popitem()[1].unregister()

    def add(self, place, value, raw=b''):
        with self._lock:
            self.records.append(record(place, self.moment, value, raw))

    def _take(self, message, topic):
        header = message._connection_header
        if isinstance(message, rospy.AnyMsg):
            raw = message._buff
            kind = roslib.message.get_message_class(header['type'])
            if kind is None:
                self.unreadable.add(header['type'])
                return
            message = kind().deserialize(raw)
        else:  # rospy hands out what another subscriber of this process asked for
            buffer = io.BytesIO()
            message.serialize(buffer)
            raw = buffer.getvalue()
        self.add(topic, message, raw)
        self.add(f'{topic} connection', {name: value for name, value in header.items() if isinstance(value, str)})

    def look(self):
        """Subscribes to new topics with a publisher; records parameters and the names of nodes, topics and services anew."""
        published = {topic for topic, _ in self._master.getSystemState()[0]}
        for topic, kind in self._master.getTopicTypes():
            # Of one that a former server published, rospy would hand out what another subscriber of this process got.
            if topic in published and topic not in self._subscribers:
                self._subscribers[topic] = rospy.Subscriber(topic, rospy.AnyMsg, self._take, topic)
                self.add('topic', [topic, kind])
        state = {'parameters': rospy.get_param('/'), 'graph': self._master.getSystemState()}
        for place, value in state.items():
            if repr(value) not in self._seen:
                self._seen.add(repr(value))
                self.add(place, value)

    def attach(self, node):
        """Waits until every topic that a node publishes is recorded."""
        publishers, _, _ = self._master.getSystemState()
        self.look()  # after it: each of these topics is known now
        for topic, nodes in publishers:
            if node in nodes:
                wait_until(self._subscribers[topic].get_num_connections, f'{topic} is recorded')

    def recorded_topics(self):
        return {seen.place for seen in self.records}

    def add_process(self, child):
        """Arguments, environment and output of a process."""
        for name in 'cmdline', 'environ':
            with open(f'/proc/{child.process.pid}/{name}', 'rb') as file:
                self.add(name, file.read().split(b'\0'))
        self.add('output', child.output().splitlines())

