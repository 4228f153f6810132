"""The words that several commands share: each means one thing, whatever the command."""
from options import Option

TIME_LIMIT = 30  # s
METHODS = ('icp', 'gicp', 'ndt', 'ppcr', 'ransac', 'fgr', 'teaser')
BASELINES = ('icp_pcl', 'gicp_pcl', 'ndt_pcl', 'ndt_1m', 'ndt_coarse_to_fine', 'ppcr_text', 'do_nothing')

WORDS = {option.name: option for option in (
    Option('root', 'folder of the data sets, in the common layout', 'folder'),
    Option('name', 'name of the sequence, where it is another than the input\'s', metavar='NAME'),
    Option('run', 'folder of a run and its results; an interrupted run goes on', 'path', 'DIR'),
    Option('logs', 'folder of the original logs', 'path', 'DIR'),
    Option('sequences', 'sequences, data sets or data_set/sequence', metavar='NAME', many=True),
    Option('kind', 'kind of problems: small initial misalignments, or large ones', choices=('local', 'global', 'both')),
    Option('method', 'registration method', metavar='NAME'),
    Option('plugin', 'shared library with registration methods of your own', 'path', 'FILE'),
    Option('parameters', 'YAML file of the method\'s parameters', 'file'),
    Option('presentation', 'how problems are shown: two clouds, or a map and a scan in its sensor\'s frame',
           choices=('registration', 'localization')),
    Option('subset', 'number of problems to draw; 0 = all', 'int', low=0, default=0),
    Option('seed', 'seed of all that is drawn at random', 'int', low=0, high=2**31 - 1, default=1),
    Option('time-limit', 'seconds that one problem may take', 'number', low=1e-3, default=TIME_LIMIT),
    Option('jobs', 'number of parallel workers', 'int', low=1, high=1024),
    Option('output', 'file or folder to write', 'path', short='o'),
    Option('rate', 'scans, problems or results per second', 'number', low=1e-3, high=1e3, default=2),
    Option('input', 'folders, archives or bags of the original log', metavar='INPUT', many=True, positional=True),
    Option('bounds', 'bounds of the perturbations: measured in the published problem files, or of upstream\'s note',
           choices=('measured', 'note')),
    Option('map', 'file of a map in the frame of the sequence', 'path', 'FILE'),
    Option('window', 'number of places in the sequence up to which clouds are paired', 'int', low=0),
    Option('overlap-pairs', 'number of pairs of each problem file whose overlap is recomputed', 'int', low=0),
    Option('force', 'replace files that are there and were made by other means', 'flag'),
    Option('exclude', 'names of clouds to leave out', metavar='FILE', many=True),
    Option('distance', 'distance in m below which two points belong together', 'number', low=0,
           shown_default='what the data set says'),
    Option('map-frame', 'tf frame of the map', default='map'),
    Option('scan-frame', 'tf frame of the scans'),
    Option('scans', 'list of which scan has which timestamp', 'path', 'FILE'),
    Option('topic', 'topic of the poses in a bag'),
    Option('key', 'key of a bag of problems, with which its answers are scored', 'path', 'FILE'),
    Option('yaw-only', 'turn scans without VIEWPOINT about the vertical axis only, which gives the tilt away', 'flag'),
    Option('max-rate', 'rate to thin scans to, in Hz; 0 = all scans', 'number', low=0),
    Option('poses', 'file of the poses', 'path', 'FILE'),
    Option('truth', 'whether the true poses are shown', choices=('true', 'false'), default='true'),
    Option('rviz', 'show it in rviz', 'flag'),
    Option('title', 'title of the page'),
)}
