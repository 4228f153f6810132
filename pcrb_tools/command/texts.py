"""Commands that print texts: recipes, completion, and the table of all options."""
import recipes
from options import Option, bounds, words_of

COMMANDS = []  # the table, which is complete once all modules are loaded


class Printer:
    """A command that prints a text."""

    def __init__(self, text_of, options=()):
        self.text_of, self.options = text_of, lambda: list(options)

    def check(self, values):
        return []

    def run(self, name, options, values):
        print(self.text_of(values), end='')
        return 0


RECIPES = '''\
Try everything without data:
  pcrb demo --output ~/pcrb_demo

Benchmark one method on a part of the problems, and look at where it fails:
  pcrb run --root ~/pcrb --run ~/runs/gicp --method gicp --subset 100
  pcrb replay --run ~/runs/gicp --order worst --rviz

Benchmark a method of your own, from a shared library or as a client of any language:
  pcrb run --root ~/pcrb --run ~/runs/mine --method mine --plugin libmine.so --parameters mine.yaml
  pcrb run --root ~/pcrb --run ~/runs/mine --client "python3 my_client.py"

Benchmark a localization node as it is:
  pcrb localize --root ~/pcrb --run ~/runs/node --sequences planetary_map --node "my_package my.launch" \\
    --map-topic /points_map --scan-topic /points_raw --pose-topic /ndt_pose
  pcrb localize --root ~/pcrb --run ~/runs/hdl --sequences planetary_map --node hdl_localization

Compare it with the paper's methods:
  pcrb paper --root ~/pcrb --run ~/runs/paper --subset 100
  pcrb report ~/runs/mine ~/runs/paper/gicp --output ~/runs/report

Keep it from getting worse, in continuous integration:
  pcrb run --root ~/pcrb --run run --method mine --plugin libmine.so --parameters mine.yaml --subset 100
  pcrb compare reference run --max-increase 5

Make problems of a log of your own, a bag or a folder of clouds and a text of poses:
  pcrb convert drive.bag --root ~/pcrb --data-set mine
  pcrb convert ~/scans --poses poses.txt --root ~/pcrb --data-set mine

Make problems of data of your own that lie in one frame (ROOT/DATA_SET/SEQUENCE/*.pcd):
  pcrb overlap --root ~/pcrb --sequences mine/yard
  pcrb sample --root ~/pcrb --sequences mine/yard
  pcrb check --root ~/pcrb --sequences mine/yard
'''


def all_recipes(values):
    return '\n'.join([RECIPES, 'Localization nodes that pcrb knows (--node NAME):\n', recipes.listing()])


SHELL = Option('shell', 'shell to complete in', metavar='SHELL', positional=True, required=True, choices=('bash', 'zsh'))


def completion(values):
    """A case for each command: its options; behind an option with choices these, else files."""
    names = sorted({command.name.split()[0] for command in COMMANDS})
    cases, choices = [], {}
    for command in COMMANDS:
        words = [f'--{option.name}' for option in command.options() if not option.positional]
        words += [word for option in command.options() if option.positional for word in option.choices]
        cases.append(f'    "{command.name}") words="{" ".join(words)}" ;;')
        for option in command.options():
            if option.choices and not option.positional:
                choices.setdefault(f'--{option.name}', set()).update(option.choices)
    formats = [command.name.split()[1] for command in COMMANDS if ' ' in command.name]
    behind = [f'    {name}) COMPREPLY=($(compgen -W "{" ".join(sorted(words))}" -- "$word")); return ;;'
              for name, words in sorted(choices.items())]
    return (ZSH if values['shell'] == 'zsh' else '') + BASH.format(names=' '.join(names), cases='\n'.join(cases), behind='\n'.join(behind), formats=' '.join(formats))


ZSH = '''\
(( $+functions[compdef] )) || { autoload -U +X compinit && compinit; }
autoload -U +X bashcompinit && bashcompinit
'''

BASH = '''\
_pcrb() {{
  local word=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD-1]}} command=${{COMP_WORDS[1]}} words=
  if [ "$COMP_CWORD" = 1 ]; then COMPREPLY=($(compgen -W "{names} --help --version" -- "$word")); return; fi
  if [ "$command" = convert ] && [ "$COMP_CWORD" = 2 ]; then COMPREPLY=($(compgen -W "{formats}" -- "$word")); return; fi
  if [ "$command" = convert ]; then command="convert ${{COMP_WORDS[2]}}"; fi
  case $before in
{behind}
  esac
  case $command in
{cases}
  esac
  case $word in
    -*) COMPREPLY=($(compgen -W "$words --help" -- "$word")) ;;
    *) COMPREPLY=($(compgen -f -W "$(printf '%s\\n' $words | grep -v '^--')" -- "$word")) ;;
  esac
}}
complete -o filenames -F _pcrb pcrb
'''


def table(values):
    """docs/pcrb.md: commands, and options with the commands that have them. A word means one thing, so it has one row."""
    lines = [HEAD, '## Commands', '', '| command | what it does | example |', '|---|---|---|']
    rows = {}
    for command in COMMANDS:
        lines.append(f'| `pcrb {command.name}` | {command.summary} | `{command.example}` |')
        for option in command.options():
            rows.setdefault((option.positional, option.name), []).append((command.name, option))
    lines += ['', '## Options', '', '| option | meaning | commands |', '|---|---|---|']
    for (positional, name), uses in sorted(rows.items()):
        option = uses[0][1]
        shown = (option.placeholder() if positional else option.usage()).replace('|', '\\|')
        marks = ', '.join(f'{command}{" (must be given)" if use.required else default_of(use)}' for command, use in uses)
        lines.append(f'| `{shown}` | {escaped(meanings(uses))} | {escaped(marks)} |')
    return '\n'.join(lines) + '\n'


def default_of(option):
    has_default = option.default not in (None, '', False, [])
    return f' (default {option.shown_default or words_of(option.default)})' if option.shown_default or has_default else ''


def meanings(uses):
    """What a word means; joined by `or else` where commands mean different things by it, which a test forbids."""
    option = uses[0][1]
    limits = bounds(option.low, option.high) if option.kind in ('int', 'number') and option.low is not None else ''
    return ' or else '.join(sorted({use.help for _, use in uses})) + (f' ({limits})' if limits else '')


def escaped(text):
    return text.replace('|', '\\|').replace('<', '&lt;').replace('>', '&gt;')


HEAD = '''\
# The command `pcrb`

One program in front of all others, on the PATH of a sourced workspace. `pcrb --help` lists its commands, `pcrb COMMAND
--help` the options of one. An option is written `--name VALUE`, `--name=VALUE` or, as in roslaunch, `name:=VALUE`; one
that takes several words takes them up to the next option. Everything is checked before anything starts: a mistake ends
it with status 2 and a line that says what is expected. Values stay text, so sequence `00` is no number. `source
<(pcrb completion bash)` completes commands, options and choices in bash, `source <(pcrb completion zsh)` in zsh. The ROS
nodes and launch files stay for users of ROS: [interface.md](interface.md).

This page is printed by `pcrb options`; a test compares the two.
'''
