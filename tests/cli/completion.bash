# What completion offers, the same in each shell. Sourced behind common.bash by the completion_*.sh, which define
# `completes LINE`: prints the last word of the line after Tab was pressed.

check_completion() {
    mkdir -p "$work/bin"
    ln -sf "$headrace" "$work/bin/headrace"
    export PATH="$work/bin:$PATH"
    cd "$work" || exit 1
    : >wave.mcap
    start_server
    expect 0 'dam_break: .*' "$headrace" load dam_break
    expect 0 '.*' "$headrace" call probes.add '{"probe": {"name": "gauge", "kind": {"level": {"from": [0.1, 0, 0.1], "to": [0.1, 0.5, 0.1]}}}}'

    # From the program itself: commands, options, words from a list, methods, topics, files.
    offers 'headrace rem' 'remove'
    offers 'headrace resume --unt' '--until'
    offers 'headrace resume --serv' '--server'
    offers 'headrace add ball --slip fr' 'free_slip'
    offers 'headrace call sim.insp' 'sim.inspect'
    offers 'headrace help acc' 'accuracy'
    offers 'headrace completion fi' 'fish'
    offers 'headrace info wav' 'wave.mcap'
    offers 'headrace resume --until=at-r' '--until=at-rest'
    # From the server: objects, parameters, probes, scenes.
    offers 'headrace remove pan' 'panel'
    offers 'headrace set visc' 'viscosity='
    offers 'headrace get stiff' 'stiffness'
    offers 'headrace probes ga' 'gauge'
    offers 'headrace load dam_break_2' 'dam_break_2d'
    # Without a server there is nothing to say, and nothing is said.
    HEADRACE_SERVER="ipc://$work/nobody" offers 'headrace remove pan' 'pan'
    HEADRACE_SERVER="ipc://$work/nobody" offers 'headrace load dam_break_2' 'dam_break_2d'
    [ -z "$(HEADRACE_SERVER="ipc://$work/nobody" "$headrace" __complete remove pan 2>&1)" ] ||
        fail "without a server completion says something"
}

# offers LINE WORD: after Tab the word stands at the line's end.
offers() {
    local got
    got=$(completes "$1") || fail "\`$1\` cannot be completed: $got"
    [ "$got" = "$2" ] || fail "\`$1\` becomes $got instead of $2"
}
