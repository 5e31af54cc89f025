# Files are compiled several at a time: most of the time of one goes into the headers that all include.
# A clean build takes half the time, a change of one file several times as long: who changes files
# often configures once with -DPOSEVOTE_UNITY=OFF. The presets debug and asan do without, so that a file
# that forgets to include something is found.
option(POSEVOTE_UNITY "Compile files several at a time" ON)
set(CMAKE_UNITY_BUILD ${POSEVOTE_UNITY})

# Spreads the files of a target over so many units: those of one folder, neighbours in the list, may call
# what is theirs alone alike ("registered", "Params").
function(posevote_mix_folders target units)
  set_target_properties(${target} PROPERTIES UNITY_BUILD_MODE GROUP)
  set(number 0)
  foreach(source ${ARGN})
    math(EXPR unit "${number} % ${units}")
    set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${unit})
    math(EXPR number "${number} + 1")
  endforeach()
endfunction()
