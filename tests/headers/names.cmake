# Writes a source file that names each public name of the library in a namespace that also uses std, std::chrono, Eigen
# and Sophus: it compiles if none is ambiguous. A declaration is what begins a line; a function's name is what precedes
# the first parenthesis.
cmake_policy(VERSION 3.20)
set(left_out
  Matrix3 Vector2 Vector3   # ambiguous between Eigen and Sophus, whoever else is there; ours are Eigen's
  Product                   # the contract's name; Eigen's is the type of an expression, which programs do not name
  c_locale)                 # not in every configuration
file(GLOB_RECURSE headers RELATIVE "${INCLUDE_DIR}" "${INCLUDE_DIR}/splinertia/*.hpp")
list(FILTER headers EXCLUDE REGEX "/adapters/")
set(names "")
set(text "")
foreach(include IN ITEMS algorithm chrono functional numbers numeric random ranges type_traits Eigen/Dense Eigen/Sparse
        ${headers})
  string(APPEND text "#include <${include}>\n")
endforeach()
foreach(header IN LISTS headers)
  file(READ "${INCLUDE_DIR}/${header}" code)
  set(words "(struct|class|concept|enum class|using|using Eigen::) ?[A-Za-z_0-9]+")
  set(declaration "${words}( [{:=]|;|\n)|inline constexpr [^=({;\n]*|[^ \n(=;#}/t][^\n(=;]*[(]")
  string(REGEX MATCHALL "\n((}  // )?namespace [a-z:]+|${declaration})" lines "${code}")
  set(public "")
  foreach(line IN LISTS lines)
    string(STRIP "${line}" line)
    if(line MATCHES "namespace (.*)")
      string(REGEX MATCH "^(namespace splinertia|}  // namespace detail)$" public "${line}")
    elseif(public AND line MATCHES "^${words}( [{:=])?$" AND line MATCHES "([A-Za-z_0-9]+)( [{:=])?$")
      list(APPEND names "${CMAKE_MATCH_1}")
    elseif(public AND NOT line MATCHES " operator|requires|static_cast" AND line MATCHES "[ *&]([A-Za-z_0-9]+)(<[^<]*>)?[(]?$")
      list(APPEND names "${CMAKE_MATCH_1}")
    endif()
  endforeach()
endforeach()
list(REMOVE_DUPLICATES names)
list(REMOVE_ITEM names ${left_out})
list(SORT names)
list(LENGTH names count)
if(count LESS 500)   # 543 on 2026-11-29
  message(FATAL_ERROR "only ${count} public names found in ${INCLUDE_DIR}: do the patterns above still fit?")
endif()
set(uses "")
foreach(namespace IN ITEMS std std::chrono Eigen Sophus splinertia)
  string(APPEND uses "using namespace ${namespace};\n")
endforeach()
set(each "")
foreach(name IN LISTS names)
  string(APPEND each "using together::${name};\n")
endforeach()
file(CONFIGURE OUTPUT "${OUTPUT}" CONTENT "${text}namespace together {\n${uses}}\nnamespace each {\n${each}}\n")
