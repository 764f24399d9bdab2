units si
quit
