# thinwall_built_first(<target> <component>)   `cmake --install` of the component builds the target first if it is absent,
# as the library is where only the program was built.
function(thinwall_built_first target component)
  install(CODE "if(NOT EXISTS \"$<TARGET_FILE:${target}>\")
    execute_process(COMMAND \"${CMAKE_COMMAND}\" --build \"${CMAKE_BINARY_DIR}\" --target ${target}
                    COMMAND_ERROR_IS_FATAL ANY)
  endif()" COMPONENT ${component})
endfunction()
