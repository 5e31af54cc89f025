// SPDX-License-Identifier: BSD-3-Clause
// Each script asks `posevote complete` for what fits, whose first line says whether names of files
// fit, too, and offers the rest.
#include <stdexcept>

#include "tools/docs/completion.hpp"

namespace posevote {
namespace {

// Bash splits words at '=', so only what is behind it may be offered of --set node.param=value.
constexpr const char* kBash = R"(# bash completion of posevote
_posevote() {
  local typed="${COMP_LINE:0:COMP_POINT}" words answer last head
  read -ra words <<< "$typed"
  [[ "$typed" == *[[:space:]] ]] && words+=("")
  mapfile -t answer < <("${words[0]/#\~/$HOME}" complete -- "${words[@]:1}" 2>/dev/null)
  last="${words[-1]}"
  head=""
  [[ "$last" == *=* && "$COMP_WORDBREAKS" == *=* ]] && head="${last%=*}="
  COMPREPLY=("${answer[@]:1}")
  COMPREPLY=("${COMPREPLY[@]#"$head"}")
  [[ ${#COMPREPLY[@]} -eq 1 && "${COMPREPLY[0]}" == *= ]] && compopt -o nospace
  case "${answer[0]}" in
    files) mapfile -t -O "${#COMPREPLY[@]}" COMPREPLY < <(compgen -f -- "$last"); compopt -o filenames ;;
    folders) mapfile -t -O "${#COMPREPLY[@]}" COMPREPLY < <(compgen -d -- "$last"); compopt -o filenames ;;
  esac
} 2>/dev/null
complete -F _posevote posevote
)";

constexpr const char* kZsh = R"(#compdef posevote
_posevote() {
  local -a answer
  answer=("${(@f)$(${words[1]} complete -- "${(@)words[2,CURRENT]}" 2>/dev/null)}")
  local -a fit=("${(@)answer[2,-1]}")
  (( $#fit )) && compadd -- "${(@)fit:#*=}"
  (( $#fit )) && compadd -S '' -- "${(@M)fit:#*=}"
  case $answer[1] in
    files) _files ;;
    folders) _files -/ ;;
  esac
}
if [ "$funcstack[1]" = _posevote ]; then _posevote "$@"; else compdef _posevote posevote; fi
)";

constexpr const char* kFish = R"(# fish completion of posevote
function __posevote_complete
  set -l words (commandline -opc)
  set -l typed (commandline -ct)
  set -a words "$typed"
  set -l answer ($words[1] complete -- $words[2..-1] 2>/dev/null)
  printf '%s\n' $answer[2..-1]
  switch "$answer[1]"
    case files
      __fish_complete_path (commandline -ct)
    case folders
      __fish_complete_directories (commandline -ct) ''
  end
end
complete -c posevote -f -a '(__posevote_complete)'
)";

}  // namespace

std::string completion_script(const std::string& shell) {
  if (shell == "bash") return kBash;
  if (shell == "zsh") return kZsh;
  if (shell == "fish") return kFish;
  throw std::invalid_argument("no script for the shell '" + shell +
                              "', expected bash, zsh or fish");
}

}  // namespace posevote
