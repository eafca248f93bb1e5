#!/usr/bin/env bash
# `headrace watch` on a terminal of tmux: what it shows, what its keys do, and that the terminal is as before in each ending.
# usage: watch.sh HEADRACED HEADRACE ROOT
. "$(dirname "${BASH_SOURCE[0]}")/common.bash"
start_server
cd "$work" || exit 1

# Without a terminal
expect 2 'error usage: this needs a terminal; headrace watch --once prints one snapshot' "$headrace" watch
expect 0 "no scene  empty  $HEADRACE_SERVER" "$headrace" watch --once
expect 0 'water_dam_break: .*' "$headrace" load water_dam_break
expect 0 'water_dam_break \(wcsph\)  idle  .*time +0 s.step +0.*particles +1,800.*energy error +not followed: a probe of the kind energies .*density error +mean .*' "$headrace" watch --once
expect 0 '\{.*"time_step_limit": .*\}' "$headrace" --json watch
expect 3 'error connection_failed: .*' "$headrace" --server "ipc://$work/nobody" watch --once

command -v tmux >/dev/null || { echo "no tmux here: the rest was not tried" >&2; exit 77; }
export LC_ALL=C.UTF-8 TERM=xterm
in_tmux() { tmux -S "$work/tmux" -f /dev/null "$@"; }
end_tmux() {
    in_tmux kill-server 2>/dev/null
    end_all
}
trap end_tmux EXIT
screen() { in_tmux capture-pane -p; }
shows() { [[ $(screen) =~ $1 ]]; }
# sees PATTERN: within a minute the screen matches.
sees() { wait_for 60 shows "$1" || fail "the screen never shows $1:"$'\n'"$(screen)"; }
press() { in_tmux send-keys "$@"; }
line() { press -l "$1" && press Enter; }

# A shell on the terminal, whose settings and prompt are looked at after each ending.
in_tmux new-session -d -x 100 -y 30 "PS1='ready> ' bash --norc --noprofile"
sees 'ready>'
line 'stty -g >before'
wait_for 60 test -s before || fail "no settings of the terminal"
line "echo BEF\"\"ORE"
sees 'BEFORE'
watch_begins() {
    rm -f status pid
    line "bash -c 'echo \$\$ >pid; exec \"$headrace\" watch'; echo \$? >status"
    sees 'p pause.*q quit'
    ! shows 'BEFORE' || fail "the dashboard is not on a screen of its own"
}
# has_ended STATUS: and the terminal is as before: settings, screen, cursor, keys.
has_ended() {
    wait_for 60 test -s status || fail "the dashboard does not end: $(screen)"
    [ "$(cat status)" = "$1" ] || fail "it ended with $(cat status) instead of $1: $(screen)"
    rm -f after
    line 'stty -g >after'
    wait_for 60 test -s after || fail "the shell is gone"
    cmp -s before after || fail "the terminal's settings have changed: $(cat before after)"
    sees 'BEFORE'
    [ "$(in_tmux display-message -p '#{cursor_flag} #{alternate_on}')" = '1 0' ] || fail "no cursor, or the other screen"
}

# What it shows, and that it goes on by itself
watch_begins
sees 'water_dam_break \(wcsph\)  idle'
expect 0 'job .*' "$headrace" resume --no-wait --pace 0.2
sees 'water_dam_break \(wcsph\)  running'
sees 'step  +[1-9]'
sees 'steps/s +[1-9][0-9.]* +[▁▂▃▄▅▆▇█]*[▂▃▄▅▆▇█]'
sees 'time step .*limit: [a-z]'
sees 'energy error +not followed, .*: e adds a probe'
press e
sees 'following energies \(e ends that\) at step [0-9]'
sees 'energy error +-?[0-9.e-]+ J/m '
press e
sees 'no longer following energies at step [0-9]'
sees 'energy error +not followed'
expect 0 '.*' "$headrace" call probes.add '{"probe": {"name": "energy", "kind": {"energies": {}}}}'
sees 'energy error +-?[0-9]'
press e
sees 'the probe energy tells the energy error already'

# Keys
press p
sees 'paused at step [0-9]'
sees '\(wcsph\)  paused'
press s
sees 'stepped at step [0-9]'
press r
sees 'resumed at step [0-9]'
sees '\(wcsph\)  running'
press d
sees 'remove which\?  1 tank  2 panel  Esc none'
press 7
press Escape
sees 'p pause'
expect 0 '.*panel: .*' "$headrace" objects
press d
sees 'remove which\?'
press 2
sees 'removed panel at step [0-9]'
[[ $("$headrace" objects) != *panel* ]] || fail "the panel is still there"
press d
sees '1 tank'
press Escape
expect 0 '.*' "$headrace" cancel
press s
sees 'stepped'

# Warnings and readers
expect 0 '.*' "$headrace" call stream.open '{"mode": "live"}'
sees 'frame/1 +0 frames, nobody listens'

# The size of the terminal
in_tmux resize-window -x 40 -y 8
sees $'^water_dam[^\n]*\n[^\n]*time'
sees $'q q|p pause  r resume'
in_tmux resize-window -x 100 -y 30
sees 'kinetic energy'

# Endings. The probe of energies goes with who has asked for it; another's stays.
press q
has_ended 0
[[ $("$headrace" probes) == *energy\ * ]] || fail "the probe that was there is gone: $("$headrace" probes)"
expect 0 '.*' "$headrace" call probes.remove '{"name": "energy"}'
for ending in q C-c; do
    watch_begins
    press e
    sees 'following energies \(e ends that\)'
    [[ $("$headrace" probes) == *watched_energies* ]] || fail "there is no probe: $("$headrace" probes)"
    press $ending
    case $ending in q) has_ended 0 ;; C-c) has_ended 130 ;; esac
    [[ $("$headrace" probes) != *watched_energies* ]] || fail "after $ending its probe is left: $("$headrace" probes)"
done
for signal in TERM HUP SEGV QUIT; do
    watch_begins
    kill -s $signal "$(cat pid)"
    case $signal in TERM) has_ended 130 ;; *) has_ended $((128 + $(kill -l $signal))) ;; esac
done
# Stopped by Ctrl-Z the terminal is the shell's; brought back, it is the dashboard's again.
rm -f status
line "$headrace watch"
sees 'q quit'
press C-z
sees 'Stopped'
sees 'BEFORE'
line 'stty -g >stopped'
wait_for 60 test -s stopped && cmp -s before stopped || fail "while it is stopped the terminal's settings are others"
line 'fg; echo $? >status'
sees 'p pause.*q quit'
press q
has_ended 0
# The server goes away under it, with its probe.
watch_begins
press e
sees 'following energies'
expect 0 'the server ends' "$headrace" shutdown
wait "$server_pid"
server_pid=
has_ended 3
sees 'error connection_failed: no answer'
echo "the dashboard watches, and leaves the terminal as it was"
