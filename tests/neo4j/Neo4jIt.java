import java.nio.file.Files;
import java.nio.file.Path;
import java.util.Map;
import java.util.Properties;
import org.neo4j.configuration.connectors.ConnectorPortRegister;
import org.neo4j.configuration.connectors.ConnectorType;
import org.neo4j.dbms.api.DatabaseManagementService;
import org.neo4j.dbms.api.DatabaseManagementServiceBuilder;
import org.neo4j.graphdb.QueryExecutionException;
import org.neo4j.kernel.internal.GraphDatabaseAPI;

/**
 * Neo4jIt HOME CONF [key=value ...]: one real Neo4j Community with Bolt, for tests. Prints "READY host:port" once it
 * answers with the password in NEO4J_PASSWORD. Ends on SIGTERM, or when standard input ends: it never outlives a test.
 */
public class Neo4jIt {
    public static void main(String[] words) {
        try {
            run(words);
        } catch (Throwable trouble) {
            trouble.printStackTrace();
            Runtime.getRuntime().halt(1); // Neo4j's threads would keep the process alive.
        }
    }

    static void run(String[] words) throws Exception {
        System.setProperty("log4j.shutdownHookEnabled", "false"); // Our own hook must stop Neo4j before log4j.
        Path home = Files.createDirectories(Path.of(words[0]).toAbsolutePath());
        Path conf = home.resolve("neo4j.conf");
        try (var out = Files.newBufferedWriter(conf)) {
            settings(words).store(out, null);
        }
        var neo4j = new DatabaseManagementServiceBuilder(home).loadPropertiesFromFile(conf).build();
        Runtime.getRuntime().addShutdownHook(new Thread(neo4j::shutdown));
        setPassword(neo4j, System.getenv("NEO4J_PASSWORD"));
        var ports = ((GraphDatabaseAPI) neo4j.database("system")).getDependencyResolver()
            .resolveDependency(ConnectorPortRegister.class);
        System.out.println("READY " + ports.getLocalAddress(ConnectorType.BOLT));
        System.out.flush();
        while (System.in.read() >= 0) { }
        System.exit(0);
    }

    static Properties settings(String[] words) throws Exception {
        var settings = new Properties();
        try (var in = Files.newBufferedReader(Path.of(words[1]))) {
            settings.load(in);
        }
        for (int at = 2; at < words.length; at++) {
            String[] pair = words[at].split("=", 2);
            settings.setProperty(pair[0], pair[1]);
        }
        return settings;
    }

    static void setPassword(DatabaseManagementService neo4j, String password) {
        var change = "ALTER USER neo4j SET PASSWORD $password CHANGE NOT REQUIRED";
        try {
            neo4j.database("system").executeTransactionally(change, Map.of("password", password));
        } catch (QueryExecutionException trouble) { // The second start in the same home.
            if (!trouble.getMessage().contains("cannot be the same")) throw trouble;
        }
    }
}
