# Writes EMBEDDED, a source with the texts of TEMPLATES ("kind=scene=frame|..."), files relative to FOLDER.
set(entries "")
string(REPLACE "|" ";" TEMPLATES "${TEMPLATES}")
foreach(template IN LISTS TEMPLATES)
  string(REGEX MATCH "^(.*)=(.*)=(.*)$" unused "${template}")
  set(kind "${CMAKE_MATCH_1}")
  set(scene_file "${CMAKE_MATCH_2}")
  set(frame_file "${CMAKE_MATCH_3}")
  file(READ "${FOLDER}/${scene_file}" scene)
  file(READ "${FOLDER}/${frame_file}" frame)
  if(scene_file MATCHES "^[.][.]/scenes/(.*)[.]toml$") # a scene with a name and a frame of its own
    string(REGEX REPLACE "name( *)= \"${CMAKE_MATCH_1}\"" "name\\1= \"NAME\"" scene "${scene}")
    string(REPLACE "\"${frame_file}\"" "\"NAME.geo\"" scene "${scene}")
  endif()
  string(APPEND entries "    {\"${kind}\", R\"gestell(${scene})gestell\", R\"gestell(${frame})gestell\"},\n")
endforeach()
file(WRITE "${EMBEDDED}" "#include \"apps/templates/scene_templates.h\"

std::vector<gestell::apps::SceneTemplate> gestell::apps::scene_templates()
{
  return {
${entries}  };
}
")
