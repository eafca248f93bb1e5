// The shells' side of completion: each asks `headrace __complete` what may stand next, and puts it into its own form.
#include "client/completion.h"

namespace headrace::client {

namespace {

// The line is split at blanks, not at COMP_WORDBREAKS, which cuts words at = and : too. Bash replaces only what stands
// behind the last of those, so that much is taken off each candidate.
constexpr const char* kBash = R"sh(# bash completion for headrace: eval "$(headrace completion bash)"
_headrace() {
    local line=${COMP_LINE:0:COMP_POINT} word about words=() kept candidates=() files=
    read -ra words <<<"$line"
    [[ $line == *[[:space:]] ]] && words+=("")
    local last=${words[-1]}
    kept=
    [[ $last == *[=:]* && $COMP_WORDBREAKS == *[=:]* ]] && kept=${last%"${last##*[=:]}"}
    while IFS=$'\t' read -r word about; do
        if [[ $word == :files ]]; then files=yes; else candidates+=("${word#"$kept"}"); fi
    done < <("${words[0]}" __complete "${words[@]:1}" 2>/dev/null)
    COMPREPLY=("${candidates[@]}")
    if [[ -n $files ]]; then
        compopt -o filenames 2>/dev/null
        while IFS= read -r word; do COMPREPLY+=("$word"); done < <(compgen -f -- "$last")
    fi
    # What has an end of its own goes on: viscosity=, panel@, gauge>
    [[ ${#COMPREPLY[@]} -eq 1 && ${COMPREPLY[0]} == *[=@\>] ]] && compopt -o nospace 2>/dev/null
    return 0
}
complete -F _headrace headrace
)sh";

constexpr const char* kZsh = R"sh(#compdef headrace
# zsh completion for headrace: in a folder of $fpath as _headrace, or: source <(headrace completion zsh)
_headrace() {
    local line word about files
    local -a whole open
    for line in "${(@f)$("${words[1]}" __complete "${(@)words[2,CURRENT]}" 2>/dev/null)}"; do
        word=${line%%$'\t'*} about=${line#*$'\t'}
        case $word in
            '') ;;
            :files) files=yes ;;
            *[=@\>]) open+=("${word//:/\\:}:$about") ;;
            *) whole+=("${word//:/\\:}:$about") ;;
        esac
    done
    (( ${#whole} )) && _describe -t words headrace whole
    (( ${#open} )) && _describe -t words headrace open -S ''
    [[ -n $files ]] && _files
    return 0
}
if [[ $funcstack[1] == _headrace ]]; then _headrace "$@"; else compdef _headrace headrace; fi
)sh";

constexpr const char* kFish = R"sh(# fish completion for headrace: headrace completion fish | source
function __headrace_complete
    set -l words (commandline -opc) (commandline -ct)
    set -l files
    for line in ($words[1] __complete $words[2..-1] 2>/dev/null)
        if test "$line" = ':files'
            set files yes
        else
            echo $line
        end
    end
    test -n "$files"; and __fish_complete_path (commandline -ct)
    return 0
end
complete -c headrace -f -a '(__headrace_complete)'
)sh";

}  // namespace

std::string completion_script(const std::string& shell) {
    if (shell == "bash") return kBash;
    if (shell == "zsh") return kZsh;
    if (shell == "fish") return kFish;
    return "";
}

}  // namespace headrace::client
