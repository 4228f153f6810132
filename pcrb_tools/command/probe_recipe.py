"""What pcrb probe makes of what it saw: parameters of localization_bridge, and what it could not tell."""
import dataclasses
import statistics
import textwrap

EXACT = 2e-6  # s: an answer whose stamp differs less from its scan's has that stamp
EVEN = 5e-3  # s by which a constant delay may vary
AGREE = 0.01  # m: answers that differ less are stable
DEFAULTS = {'map_topic': '/map', 'scan_topic': '/scan', 'initialpose_topic': '/initialpose', 'pose_topic': '/pose',
            'map_frame': 'map', 'odom_frame': 'odom', 'base_frame': 'base_link'}


@dataclasses.dataclass
class Verdict:
    bridge: dict = dataclasses.field(default_factory=dict)
    notes: list = dataclasses.field(default_factory=list)  # what was seen
    doubts: list = dataclasses.field(default_factory=list)  # what could not be told
    is_answered: bool = False

    def set(self, name, value):
        if DEFAULTS.get(name) != value:
            self.bridge[name] = value


def judge(seen):
    """The verdict on an Observation."""
    verdict = Verdict()
    judge_inputs(seen, verdict)
    judge_links(seen, verdict)
    channel = judge_channel(seen, verdict)
    if channel is None:
        return verdict
    answers = [answer for answer in seen.answers[channel] if answer.is_valid]
    verdict.is_answered = bool(answers)
    if answers:
        judge_stamps(answers, verdict)
        judge_settling(answers, verdict)
        judge_times(answers, seen, verdict)
    return verdict


def judge_inputs(seen, verdict):
    if seen.has_died:
        verdict.doubts.append('the node died during the probe: see what it prints')
    verdict.set('map_frame', seen.map_frame)
    verdict.set('base_frame', seen.base_frame)
    for name, topics, kind in (('map_topic', seen.map_topics, 'map'), ('scan_topic', seen.scan_topics, 'scan')):
        if topics:
            verdict.set(name, topics[0])
        if len(topics) > 1:
            verdict.doubts.append(f'which of {", ".join(topics)} takes the {kind}: give --{kind}-topic')
    if not seen.map_topics:
        files = [f'{name}: {value}' for name, value in sorted(seen.parameters.items())
                 if isinstance(value, str) and value.endswith(('.pcd', '.ply', '.bt'))]
        if seen.map_file:
            verdict.bridge.update({'map_file': seen.map_file, 'restart': 'target', 'map_settle': 3})
        else:
            verdict.doubts.append('where the node takes its map from: no topic of a cloud looks like one'
                                  + (f'; parameters that name a file: {"; ".join(files)}: give --map-file' if files else ''))
    for name, kind in (('imu_topic', 'sensor_msgs/Imu'), ('odometry_topic', 'nav_msgs/Odometry')):
        topics = [topic for topic, found in seen.subscriptions.items() if found == kind]
        if topics:
            verdict.bridge[name] = topics[0]
    initial = [topic for topic, kind in seen.subscriptions.items() if kind == 'geometry_msgs/PoseWithCovarianceStamped']
    if initial:
        verdict.set('initialpose_topic', sorted(initial)[0])
    else:
        verdict.doubts.append('how the node learns its initial pose: it subscribes to none')
    relocalize = [name for name in seen.services if any(word in name for word in ('global_localization', 'relocali'))]
    if relocalize:
        verdict.notes.append(f'for global problems: send_initialpose: false, and before_problem or after_first_scan: {relocalize[0]}')


def judge_links(seen, verdict):
    """Who publishes which link of tf: the bridge must not do so, too."""
    children = {child: (parent, is_static) for (parent, child), is_static in seen.links.items()}
    if seen.base_frame in children:
        verdict.bridge['tf_odom_base'] = 'none'
        verdict.notes.append(f'the node publishes {children[seen.base_frame][0]} -> {seen.base_frame} on tf')
    others = {child: parent for child, (parent, _) in children.items() if child != seen.base_frame and parent == seen.base_frame}
    if others:
        verdict.doubts.append('the launch file says where sensors are mounted (' + ', '.join(
            f'{parent} -> {child}' for child, parent in sorted(others.items()))
            + '): leave that out, or set scan_frame to the one and tf_base_scan: none')
    loaders = [topic for topic in [*seen.map_topics, *seen.scan_topics, '/initialpose'] if topic in seen.publications]
    if loaders:
        verdict.doubts.append(f'another node publishes {", ".join(loaders)}, which the bridge does: leave it out of the launch file'
                              + ('; if it reads the map from a file when it starts, give --map-file' if loaders[0] in seen.map_topics else ''))


def score_of(answers):
    """Channels are compared by how many scans they answer with the scan's own stamp, then with any."""
    valid = [answer for answer in answers if answer.is_valid]
    own = {answer.scan for answer in valid if abs(answer.lateness) < EXACT}
    return (len(valid) > 0, len(own), len({answer.scan for answer in valid}))


def judge_channel(seen, verdict):
    """The topic, or the link of tf, on which the node answers."""
    if not seen.answers:
        poses = [f'{topic} ({kind})' for topic, kind in sorted(seen.publications.items()) if kind in
                 ('geometry_msgs/PoseStamped', 'geometry_msgs/PoseWithCovarianceStamped', 'nav_msgs/Odometry', 'geometry_msgs/TransformStamped')]
        verdict.doubts.append('the node answered none of ten scans'
                              + (f'; it publishes poses on {", ".join(poses)}' if poses else '; it publishes no topic of poses')
                              + ': it may wait for another input, or reject its own results: see what it prints')
        return None
    channel = max(sorted(seen.answers, key=lambda name: (isinstance(name, tuple), str(name))), key=lambda name: score_of(seen.answers[name]))
    if isinstance(channel, tuple):
        verdict.bridge['pose_topic'] = 'tf'
        if channel[1] != seen.base_frame:
            verdict.bridge['tf_odom_base'] = 'dynamic'
            verdict.set('odom_frame', channel[1])
    else:
        verdict.set('pose_topic', channel)
    invalid = sum(not answer.is_valid for answer in seen.answers[channel])
    if invalid:
        verdict.doubts.append(f'{invalid} of {len(seen.answers[channel])} poses are no pose: NaN, or a quaternion of another norm than 1')
    parents = {answer.parent for answer in seen.answers[channel]} - {seen.map_frame, ''}
    if parents:
        verdict.doubts.append(f'answers are in frame {", ".join(sorted(parents))}: is that the map\'s (map_frame), or does a link of tf lack?')
    rest = [str(name if isinstance(name, str) else '{} -> {} on tf'.format(*name)) for name in seen.answers if name != channel]
    if rest:
        verdict.notes.append(f'it also answers on {", ".join(sorted(rest))}')
    return channel


def judge_stamps(answers, verdict):
    late = [answer.lateness for answer in answers]
    if max(abs(value) for value in late) < EXACT:
        return
    median = statistics.median(late)
    if max(late) - min(late) <= EVEN:
        verdict.bridge['answer_delay'] = round(median, 4)
        verdict.notes.append(f'answers are stamped {median:.4f} s after their scans')
    else:
        verdict.bridge['match'] = 'arrival'
        verdict.notes.append('answers have the stamp of no scan: they belong to the scan sent last')


def errors_by_scan(answers):
    """Error of the last answer to each scan, an echo of the initial pose left out."""
    errors = {}
    for answer in answers:
        if not answer.is_echo:
            errors[answer.scan] = answer.error
    return [errors[scan] for scan in sorted(errors)]


def judge_settling(answers, verdict):
    """The rule that takes the best answer: motion models overshoot after the first one, filters approach slowly."""
    errors = errors_by_scan(answers)
    if any(answer.is_echo for answer in answers):
        verdict.notes.append('its first answer repeats the initial pose, which does not count')
    if not errors:
        verdict.doubts.append('the node said nothing but the initial pose')
        return
    shown = ', '.join(f'{error:.3f}' for error in errors)
    verdict.notes.append(f'errors over the scans, m: {shown} (the initial pose was off by 0.364)')
    best, first, last = min(errors), errors[0], errors[-1]
    spread = max(errors[-3:]) - min(errors[-3:])
    grows = last > 2 * first + AGREE
    if grows or first <= max(1.5 * best, best + AGREE):
        rule = 'first'
    elif spread < AGREE and len(errors) > 3:
        rule = 'stable'
    else:
        rule = 'deadline'
    verdict.set('settle', rule)
    if grows:
        verdict.notes.append('the error grows with further scans: a motion model takes the correction for motion')
    if best > 0.3:
        verdict.doubts.append('no answer is much better than the initial pose: are its parameters right for a room of 12 x 8 m?')


def judge_times(answers, seen, verdict):
    delays = [answer.delay for answer in answers]
    scans = len({answer.scan for answer in answers})
    verdict.notes.append(f'{scans} of 10 scans were answered, after {statistics.median(delays):.3f} s (median), at most {max(delays):.3f} s')
    if statistics.median(delays) > 0.1:
        verdict.notes.append('give it time: --time-limit of at least %d s' % max(10, round(30 * statistics.median(delays))))


def text_of(verdict, node, file):
    """The recipe as YAML with comments; the command that uses it."""
    lines = ['# Parameters of localization_bridge, as pcrb probe found them out.']
    for title, texts in (('seen', verdict.notes), ('could not tell', verdict.doubts)):
        for text in texts:
            lines += textwrap.wrap(f'{title}: {text}', 120, initial_indent='# ', subsequent_indent='#   ')
    lines += [f'{name}: {value}' for name, value in verdict.bridge.items()]
    if not verdict.bridge:
        lines.append('{}')
    lines += ['# pcrb localize --root ROOT --run RUN --node ' + node + f' --bridge-parameters {file}']
    return '\n'.join(lines) + '\n'
